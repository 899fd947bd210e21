"""Messages of an export, a check or an import: what is wrong, where in the scene, and what to do about it."""

from dataclasses import dataclass, field

ERROR, WARNING, INFO = "ERROR", "WARNING", "INFO"


@dataclass
class Finding:
    """One message. It names its object and bone, so that a click can select them. Names stay valid when Blender undoes; pointers
    do not."""

    severity: str
    message: str
    object_name: str = ""
    bone_name: str = ""
    vertices: list = field(default_factory=list)
    code: str = ""

    def __str__(self):
        location = self.object_name + (f", bone {self.bone_name}" if self.bone_name else "")
        return f"{location}: {self.message}" if location else self.message


class Findings(list):
    """Messages in the order they were found."""

    def error(self, message, **about):
        self.append(Finding(ERROR, message, **about))

    def warning(self, message, **about):
        self.append(Finding(WARNING, message, **about))

    def info(self, message, **about):
        self.append(Finding(INFO, message, **about))

    @property
    def errors(self):
        return [one for one in self if one.severity == ERROR]

    def show(self, operator, max_count=8):
        """Reports the messages as Blender does: status bar, info editor, and a pop-up for errors."""
        for one in self[:max_count]:
            operator.report({one.severity}, str(one))
        if len(self) > max_count:
            operator.report({"INFO"}, f"{len(self) - max_count} more messages are in Scene > Soft body format > Check")

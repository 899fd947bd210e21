"""What an export, a check or an import has to say: what is wrong, where in the scene, and what to do about it."""

from dataclasses import dataclass, field

ERROR, WARNING, INFO = "ERROR", "WARNING", "INFO"


@dataclass
class Finding:
    """One message. What it is about is named, so that a click can select it: names of objects and bones stay true when
    Blender undoes, pointers do not."""

    severity: str
    message: str
    object_name: str = ""
    bone_name: str = ""
    vertices: list = field(default_factory=list)
    code: str = ""

    def __str__(self):
        place = self.object_name + (f", bone {self.bone_name}" if self.bone_name else "")
        return f"{place}: {self.message}" if place else self.message


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

    def show(self, operator, most=8):
        """In Blender's own way: the status bar, the info editor, a pop-up for errors."""
        for one in self[:most]:
            operator.report({one.severity}, str(one))
        if len(self) > most:
            operator.report({"INFO"}, f"{len(self) - most} more messages stand in Scene > Soft body format > Check")

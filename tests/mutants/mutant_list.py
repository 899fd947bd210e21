"""Reads the list of mistakes in mutants.txt, and finds each of them in the source."""
import os
from dataclasses import dataclass

FOLDERS = (("libsbfmt/export/", "export"), ("libsbfmt/", "libsbfmt"), ("runtime/", "runtime"), ("tools/", "tools"),
           ("exporters/blender/", "add-on"))
KEYS = ("mistake", "file", "under", "before", "after", "tests")
REQUIRED = [key for key in KEYS if key != "under"]


class ListError(Exception):
    """The list itself is invalid."""


@dataclass
class Mutant:
    line: int  # of its first key in the list
    mistake: str
    file: str
    before: str
    after: str
    tests: tuple
    under: str = ""

    @property
    def folder(self):
        return next(name for start, name in FOLDERS if self.file.startswith(start))

    def apply(self, text):
        """The file's text with the mistake in it."""
        start = 0
        if self.under:
            start = text.find(self.under)
            if start < 0:
                raise ListError(f"line {self.line}: {self.file} no longer has the text '{self.under}'")
        found = text.count(self.before, start)
        if found == 0:
            raise ListError(f"line {self.line}: {self.file} no longer has the text '{self.before}'")
        if found > 1 and not self.under:
            raise ListError(f"line {self.line}: {self.file} has the text '{self.before}' {found} times: add 'under TEXT'")
        at = text.index(self.before, start)
        return text[:at] + self.after + text[at + len(self.before):]


def parse_block(lines):
    """One mutant of its lines, (number, text) each."""
    values = {}
    for number, text in lines:
        key, _, value = text.partition(" ")
        if key not in KEYS:
            raise ListError(f"line {number}: '{key}' is none of {', '.join(KEYS)}")
        if key in values:
            raise ListError(f"line {number}: '{key}' is there twice; an empty line ends a mutant")
        values[key] = value.strip()
    first = lines[0][0]
    missing = [key for key in REQUIRED if not values.get(key) and key != "after"]
    if missing or "after" not in values:
        raise ListError(f"line {first}: no '{(missing or ['after'])[0]}'")
    if not values["file"].startswith(tuple(start for start, _ in FOLDERS)):
        raise ListError(f"line {first}: {values['file']} is in none of the folders {', '.join(start for start, _ in FOLDERS)}")
    if values["before"] == values["after"]:
        raise ListError(f"line {first}: 'before' and 'after' are the same")
    values["tests"] = tuple(values["tests"].split())
    return Mutant(line=first, **values)


def read_mutants(path):
    mutants, block = [], []
    with open(path, encoding="utf-8") as stream:
        for number, text in enumerate([*stream, "\n"], 1):
            text = text.rstrip("\n")
            if text.startswith("#"):
                continue
            if text.strip():
                block.append((number, text))
            elif block:
                mutants.append(parse_block(block))
                block = []
    return mutants


def check_mutants(mutants, root):
    """Errors of the list, compared with the source."""
    faults = []
    for mutant in mutants:
        path = os.path.join(root, mutant.file)
        if not os.path.isfile(path):
            faults.append(f"line {mutant.line}: there is no file {mutant.file}")
            continue
        with open(path, encoding="utf-8") as stream:
            try:
                mutant.apply(stream.read())
            except ListError as error:
                faults.append(str(error))
        for test in mutant.tests:
            folder, _, name = test.partition("/")
            name = name.partition(":")[0]
            names = (f"{name}.c", f"{name}.py", f"test_{name}.py", f"{name}.gd")
            if not any(os.path.isfile(os.path.join(root, "tests", folder, one)) for one in names):
                faults.append(f"line {mutant.line}: there is no test {test}")
    return faults

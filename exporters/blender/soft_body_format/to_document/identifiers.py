"""Makes ids that are stable and unique in the file from names that may be neither."""

import re


class Identifiers:
    """Gives every object an id, `kind.name`, with a number appended if that is taken."""

    def __init__(self):
        self.taken, self.given = set(), {}

    def new(self, kind, name):
        plain = re.sub(r"[\s<>&\"']+", "_", name.strip()) or "unnamed"
        wanted, number = f"{kind}.{plain}", 2
        while wanted in self.taken:
            wanted, number = f"{kind}.{plain}.{number}", number + 1
        self.taken.add(wanted)
        return wanted

    def of(self, kind, key, name, imported=""):
        """The id of an object, made at the first call. Imported objects keep their id unless a copy has it already. `key` distinguishes
        objects with equal names."""
        if (kind, key) not in self.given:
            if imported and imported not in self.taken:
                self.taken.add(imported)
                self.given[kind, key] = imported
            else:
                self.given[kind, key] = self.new(kind, name)
        return self.given[kind, key]

    def known(self, kind, key):
        """The id of an object, or None if it has none yet."""
        return self.given.get((kind, key))

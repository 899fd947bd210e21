"""Ids: stable, unique in the file, from names that need be neither."""

import re


class Identifiers:
    """Gives every thing an id, `kind.name`, with a number behind where that is taken."""

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
        """The id of a thing, given when it is first asked for: the one it was imported with, unless a copy has that already.
        `key` tells things of one name apart."""
        if (kind, key) not in self.given:
            if imported and imported not in self.taken:
                self.taken.add(imported)
                self.given[kind, key] = imported
            else:
                self.given[kind, key] = self.new(kind, name)
        return self.given[kind, key]

    def known(self, kind, key):
        """The id that was given, or None."""
        return self.given.get((kind, key))

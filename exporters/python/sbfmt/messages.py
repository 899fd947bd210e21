"""Findings of the library as Python objects."""

import collections

SEVERITIES = ("error", "warning", "info")

Diagnostic = collections.namedtuple("Diagnostic", "code severity message path file line offset index")
Diagnostic.__doc__ = """One finding. `code` is a stable word, as in spec/codes.md; line 0, offset -1 and index -1: not known."""


class Error(Exception):
    """A call that failed. `fault` is "input" where the file is at fault, else "call"."""

    def __init__(self, diagnostic, fault):
        place = diagnostic.file + (f":{diagnostic.line}" if diagnostic.line else "")
        text = f"{place}: {diagnostic.message}" if place else diagnostic.message
        super().__init__(f"{text} [{diagnostic.code}]" + (f" at {diagnostic.path}" if diagnostic.path else ""))
        self.diagnostic, self.fault = diagnostic, fault
        self.code, self.message, self.path = diagnostic.code, diagnostic.message, diagnostic.path
        self.file, self.line = diagnostic.file, diagnostic.line


class Cancelled(Error):
    """The progress callback said no."""

"""Diagnostics of the library as Python objects."""

import collections

SEVERITIES = ("error", "warning", "info")

Diagnostic = collections.namedtuple("Diagnostic", "code severity message path file line offset index")
Diagnostic.__doc__ = """One diagnostic. `code` is a stable name from spec/codes.md. Line 0, offset -1 and index -1: unknown."""


class Error(Exception):
    """A failed call. `fault` is "input" if the file is at fault, else "call"."""

    def __init__(self, diagnostic, fault):
        location = diagnostic.file + (f":{diagnostic.line}" if diagnostic.line else "")
        text = f"{location}: {diagnostic.message}" if location else diagnostic.message
        super().__init__(f"{text} [{diagnostic.code}]" + (f" at {diagnostic.path}" if diagnostic.path else ""))
        self.diagnostic, self.fault = diagnostic, fault
        self.code, self.message, self.path = diagnostic.code, diagnostic.message, diagnostic.path
        self.file, self.line = diagnostic.file, diagnostic.line


class Cancelled(Error):
    """The progress callback returned False."""

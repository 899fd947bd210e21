"""Faults of the add-on itself, told in Blender's way: where they happened, and that nothing was written."""

import functools
import os
import traceback


def words_of(error):
    """What to say of an exception nobody expected."""
    last = traceback.extract_tb(error.__traceback__)[-1]
    what = "not enough memory" if isinstance(error, MemoryError) else f"{type(error).__name__}: {error}"
    return f"a fault of the add-on stopped this, and files are as they were: {what} " \
        f"({os.path.basename(last.filename)}, line {last.lineno}). Please report it with these words"


def told(execute):
    """For an operator's `execute`: an exception nobody expected becomes a report with its place, and the operator is cancelled."""
    @functools.wraps(execute)
    def guarded(self, context):
        try:
            return execute(self, context)
        except Exception as error:  # pylint: disable=broad-except
            self.report({"ERROR"}, words_of(error))
            return {"CANCELLED"}
    return guarded

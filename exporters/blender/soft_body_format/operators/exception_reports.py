"""Reports unexpected exceptions of the add-on in Blender: where they happened, and that nothing was written."""

import functools
import os
import traceback


def words_of(error):
    """The message for an unexpected exception."""
    last = traceback.extract_tb(error.__traceback__)[-1]
    what = "not enough memory" if isinstance(error, MemoryError) else f"{type(error).__name__}: {error}"
    return f"a fault of the add-on stopped this, and files are as they were: {what} " \
        f"({os.path.basename(last.filename)}, line {last.lineno}). Please report it with these words"


def report_exceptions(execute):
    """Decorates an operator's `execute`: reports an unexpected exception with its location and cancels the operator."""
    @functools.wraps(execute)
    def guarded(self, context):
        try:
            return execute(self, context)
        except Exception as error:  # pylint: disable=broad-except
            self.report({"ERROR"}, words_of(error))
            return {"CANCELLED"}
    return guarded

"""Long operators. In a window they run in steps, show progress and stop at Escape. Without a window they run at once."""

import time

from .. import sbfmt
from ..finishing import has_library
from .exception_reports import words_of

BIT_S = 0.05  # work between two checks for Escape


class Refused(Exception):
    """The reason why an operator does not do its work."""


class Working:
    """`work` is a generator of (step, fraction done). It raises Refused with a message. Closing it must restore everything."""

    generator = timer = None

    def work(self, context):
        raise NotImplementedError

    def execute(self, context):
        self.generator = self.work(context)
        return self.go_on(context, float("inf"))

    def invoke(self, context, _event):
        if context.window is None:
            return self.execute(context)
        self.generator = self.work(context)
        manager = context.window_manager
        manager.progress_begin(0, 100)
        self.timer = manager.event_timer_add(0.02, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self.generator.close()
            self.end(context)
            self.report({"INFO"}, "cancelled; nothing has changed")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        done = self.go_on(context, BIT_S)
        if done != {"RUNNING_MODAL"}:
            self.end(context)
        return done

    def cancel(self, context):
        """Called when Blender ends the operator, for example when its window closes."""
        self.generator.close()
        self.end(context)

    def end(self, context):
        if self.timer is not None:
            context.window_manager.event_timer_remove(self.timer)
            context.window_manager.progress_end()
            self.timer = None
        if context.workspace is not None:
            context.workspace.status_text_set(None)

    def go_on(self, context, seconds):
        until = time.monotonic() + seconds
        try:
            for what, fraction in self.generator:
                if time.monotonic() > until:
                    context.window_manager.progress_update(100 * fraction)
                    context.workspace.status_text_set(f"{what} {fraction:.0%}. Escape cancels")
                    return {"RUNNING_MODAL"}
        except Refused as refused:
            if str(refused):
                self.report({"ERROR"}, str(refused))
            return {"CANCELLED"}
        except (sbfmt.Error, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        except Exception as error:  # pylint: disable=broad-except
            self.report({"ERROR"}, words_of(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class WithLibrary(Working):
    """Work that needs the compiled library. `instead` is the command line that does the same."""

    instead = ""

    @classmethod
    def poll(cls, _context):
        if not has_library():
            cls.poll_message_set(f"The compiled library {sbfmt.library_fault()}. Or run {cls.instead} on the exported file")
            return False
        return True

"""Operators whose work takes a while: in a window bit by bit, with progress and Escape; without one at a stroke."""

import time

from .. import sbfmt
from ..finishing import has_library
from .own_faults import words_of

BIT_S = 0.05  # of work between two looks at the keyboard


class Refused(Exception):
    """What an operator tells instead of doing its work."""


class Working:
    """`work` is a generator of (what it does, share of it that is done). It raises Refused with what to tell; closed, it must leave
    everything as it was."""

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
        """Blender ends it, as when its window closes."""
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
            for what, share in self.generator:
                if time.monotonic() > until:
                    context.window_manager.progress_update(100 * share)
                    context.workspace.status_text_set(f"{what} {share:.0%}. Escape cancels")
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
    """Work that only the compiled library can do; `instead` is the command that does it outside."""

    instead = ""

    @classmethod
    def poll(cls, _context):
        if not has_library():
            cls.poll_message_set(f"The compiled library {sbfmt.library_fault()}. Or run {cls.instead} on the exported file")
            return False
        return True

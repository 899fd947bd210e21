"""Levels of detail in the runtime: the functions of sbrun/detail.h.

    from sbfmt import detail, runtime
    model = runtime.Model(asset, detail_levels=True)
    with runtime.World(runtime.flat(0.0), capacity=200) as world:
        detail.choose(world, error_px=0.5, budget_us=4000)
        lizards = [world.add(model, position=(2 * i, 0, 0), detail_level=len(detail.detail_levels(model)) - 2) for i in range(200)]
        detail.set_views(world, [detail.view(eye=(0, 1.7, -4), forward=(0, -0.1, 1))])
        world.step(1 / 60)
        print(detail.visits(world), [detail.detail_level(lizard) for lizard in lizards])

Without `choose` the host sets the levels of characters itself, by `set_detail_level`.
"""

import collections
import ctypes
import functools
import math
from ctypes import POINTER, Structure, byref, c_double, c_float, c_int, c_size_t, c_uint32, c_void_p

from .library import DiagnosticStruct, check
from .runtime import C, ERROR, Double3, Vec3, W, runtime_library

KINDS = ("soft", "jiggle", "bones", "away")
SHOWN = ("by_views", "always", "never")
CHOSEN = 0xFFFFFFFF  # of set_detail_level: the world chooses
MAX_VIEWS = 4

# A detail level: one of KINDS, level of soft bodies, error in metres, element visits per tick, memory in bytes.
DetailLevel = collections.namedtuple("DetailLevel", "kind level error_m visits bytes")


class DetailLevelStruct(Structure):
    _fields_ = [("kind", c_int), ("level", c_uint32), ("error_m", c_float), ("visits", c_float), ("bytes", c_size_t)]


class Definition(Structure):
    _fields_ = [("cookie", c_uint32), ("error_px", c_float), ("budget_us", c_float), ("ns_per_visit", c_float), ("coarsen_fraction", c_float),
                ("stay_s", c_float), ("offscreen_after_s", c_float)]


class View(Structure):
    _fields_ = [("eye", Double3), ("forward", Vec3), ("height_rad", c_float), ("width_ratio", c_float), ("lines", c_float)]


# Tests compare their sizes with the headers.
STRUCTS = {"sbr_detail_level": DetailLevelStruct, "sbr_detail_definition": Definition, "sbr_view": View}

CALLS = {
    "sbr_model_get_detail_levels": (c_uint32, [c_void_p, POINTER(DetailLevelStruct), c_uint32]),
    "sbr_character_get_detail_level": (c_uint32, [W, C]),
    "sbr_character_set_detail_level": (None, [W, C, c_uint32]),
    "sbr_character_get_detail_fade": (c_float, [W, C]),
    "sbr_default_detail_definition": (Definition, []),
    "sbr_world_select_detail_levels": (c_int, [W, POINTER(Definition), ERROR]),
    "sbr_world_set_views": (None, [W, POINTER(View), c_uint32]),
    "sbr_character_set_visibility": (None, [W, C, c_int]),
    "sbr_character_get_error_px": (c_float, [W, C]),
    "sbr_world_get_element_visits": (c_double, [W]),
}


@functools.lru_cache(maxsize=None)
def _library():
    loaded = runtime_library()
    for name, (result, arguments) in CALLS.items():
        function = getattr(loaded, name)
        function.restype, function.argtypes = result, arguments
    return loaded


def _of(name, character, *arguments):
    _library()
    return character.call(name, *arguments)


def detail_levels(model):
    """Detail levels of a model, finest first; only one if it was made without `detail_levels`."""
    count = _library().sbr_model_get_detail_levels(model.pointer, None, 0)
    found = (DetailLevelStruct * count)()
    _library().sbr_model_get_detail_levels(model.pointer, found, count)
    return [DetailLevel(KINDS[one.kind], one.level, one.error_m, one.visits, one.bytes) for one in found]


def detail_level(character):
    """The character's detail level, or the one it starts to change to in the next tick; from 0."""
    return _of("sbr_character_get_detail_level", character)


def set_detail_level(character, number):
    """Sets its detail level from the next tick on; CHOSEN: the world chooses again."""
    _of("sbr_character_set_detail_level", character, number)


def fade(character):
    """Remaining part of its skin's transition between levels: from 1 to 0."""
    return _of("sbr_character_get_detail_fade", character)


def choose(world, **wanted):
    """Lets the world choose detail levels from now on: by error_px, budget_us, ns_per_visit, coarsen_fraction, stay_s, offscreen_after_s."""
    definition = _library().sbr_default_detail_definition()
    known = {name for name, _ in Definition._fields_} - {"cookie"}
    for name, value in wanted.items():
        if name not in known:
            raise TypeError(f"choose() takes {', '.join(sorted(known))}, not {name!r}")
        setattr(definition, name, value)
    error = DiagnosticStruct()
    check(_library().sbr_world_select_detail_levels(world.pointer, byref(definition), byref(error)), error)


def view(eye, forward, height=math.radians(60), ratio=16 / 9, lines=1080):
    """A camera: position, direction of any length, vertical angle of view, width over height, and height in pixels."""
    return View(Double3(*eye), Vec3(*forward), height, ratio, lines)


def set_views(world, views):
    """Sets the views for the next frames, at most MAX_VIEWS; without views no character is visible."""
    if len(views) > MAX_VIEWS:
        raise ValueError(f"a world has at most {MAX_VIEWS} views, not {len(views)}")
    _library().sbr_world_set_views(world.pointer, (View * len(views))(*views), len(views))


def show(character, shown):
    """Overrides visibility, one of SHOWN: for example always behind a mirror, never behind a wall."""
    if shown not in SHOWN:
        raise ValueError(f"shown is one of {', '.join(SHOWN)}, not {shown!r}")
    _of("sbr_character_set_visibility", character, SHOWN.index(shown))


def error_px(character):
    """Its estimated largest error now, in pixels; 0: it is not visible."""
    return _of("sbr_character_get_error_px", character)


def visits(world):
    """Estimated cost of all characters in the last tick, in element visits."""
    return _library().sbr_world_get_element_visits(world.pointer)

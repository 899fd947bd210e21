"""The runtime: simulates characters of a built asset; the functions of sbrun/sbrun.h.

    from sbfmt import runtime
    with runtime.World(runtime.flat(0.0)) as world:
        lizard = world.add(runtime.Model(asset))
        lizard.drive(forward=0.3)
        for _ in range(60):
            world.step(1 / 60)
        points = numpy.frombuffer(lizard.skin(0), dtype="f4").reshape(-1, 3)

Lengths are in metres, +Y is up. Results are ctypes arrays of floats, which numpy and memoryview accept without a copy. Positions are
relative to `Character.origin`. A model keeps its asset, a world its models. Only one thread at a time may use a world.
"""

import ctypes
import ctypes.util
import functools
import glob
import os
import weakref
from ctypes import POINTER, Structure, byref, c_bool, c_double, c_float, c_int, c_int32, c_size_t, c_uint8, c_uint32, c_uint64, c_void_p

from .library import DiagnosticStruct, Report, check, diagnostic_of, library, library_path

NAME = "sbrun"
SCHEMES = ("automatic", "symplectic", "position_based", "relaxation", "explicit_euler", "heun", "block_descent")
NONE = -1  # no clip, or no bone mask


class Vec3(Structure):
    _fields_ = [("x", c_float), ("y", c_float), ("z", c_float)]


class Double3(Structure):
    _fields_ = [("x", c_double), ("y", c_double), ("z", c_double)]


class Ground(Structure):
    _fields_ = [("height", c_void_p), ("user", c_void_p), ("parameters", c_double * 4)]

    def height_at(self, x, z):
        """m."""
        normal = Vec3()
        return HEIGHT(self.height)(byref(self), x, z, byref(normal))


HEIGHT = ctypes.CFUNCTYPE(c_double, POINTER(Ground), c_double, c_double, POINTER(Vec3))


class Tasks(Structure):
    _fields_ = [("run", c_void_p), ("user", c_void_p)]


class ModelOptions(Structure):
    _fields_ = [("cookie", c_uint32), ("allocator", c_void_p), ("level", c_uint32), ("scheme", c_int), ("substeps", c_uint32),
                ("free", c_bool), ("has_gravity", c_bool), ("gravity", Vec3), ("tear_points", c_uint32), ("step_error_m", c_float),
                ("instructions", c_int), ("rigid_substeps", c_uint32), ("detail_levels", c_bool),
                ("rigid_coarse", c_bool)]


class WorldDefinition(Structure):
    _fields_ = [("cookie", c_uint32), ("allocator", c_void_p), ("tasks", Tasks), ("ground", Ground), ("has_gravity", c_bool),
                ("gravity", Vec3), ("control_tick_s", c_double), ("longest_frame_s", c_double), ("character_capacity", c_uint32),
                ("sleep_after_s", c_double), ("collider_capacity", c_uint32), ("event_capacity", c_uint32), ("hit_speed", c_float),
                ("user_data", c_void_p)]


class CharacterDefinition(Structure):
    _fields_ = [("cookie", c_uint32), ("position", Double3), ("heading", c_float), ("scale", c_float), ("hold_pose", c_bool),
                ("ground", Ground), ("detail_level", c_uint32), ("user_data", c_void_p)]


class CharacterId(Structure):
    _fields_ = [("value", c_uint32)]


class Transform(Structure):
    """Seven floats: position, and rotation as x, y, z, w."""

    _fields_ = [("position", c_float * 3), ("rotation", c_float * 4)]


class ClipPlay(Structure):
    _fields_ = [("cookie", c_uint32), ("weight", c_float), ("fade_s", c_float), ("speed", c_float), ("start_s", c_float),
                ("bone_mask", c_int32)]


class BodyHealth(Structure):
    _fields_ = [("volume_ratio", c_float), ("max_strain", c_float), ("finite", c_bool), ("inverted", c_bool), ("recoveries", c_uint32),
                ("kinetic_j", c_double), ("elastic_j", c_double), ("potential_j", c_double), ("torn", c_uint32),
                ("unsplit", c_uint32), ("asleep", c_bool), ("rigid", c_bool),
                ("min_element_ratio", c_float)]


# Tests compare their sizes with the headers.
STRUCTS = {"sbr_ground": Ground, "sbr_model_options": ModelOptions, "sbr_world_definition": WorldDefinition,
           "sbr_character_definition": CharacterDefinition, "sbr_transform": Transform, "sbr_clip_play": ClipPlay,
           "sbr_body_health": BodyHealth}

# Result and arguments. W, C: a world and a character in it.
W, C, ERROR, FLOATS = c_void_p, CharacterId, POINTER(DiagnosticStruct), POINTER(c_float)
CALLS = {
    "sbr_ground_flat": (Ground, [c_double]),
    "sbr_ground_mesh_create": (c_int, [c_void_p, FLOATS, c_uint32, POINTER(c_uint32), c_uint32, c_double, POINTER(c_void_p), ERROR]),
    "sbr_ground_mesh_destroy": (None, [c_void_p]),
    "sbr_ground_from_mesh": (Ground, [c_void_p]),
    "sbr_default_model_options": (ModelOptions, []),
    "sbr_model_create": (c_int, [c_void_p, POINTER(ModelOptions), POINTER(c_void_p), ERROR]),
    "sbr_model_destroy": (None, [c_void_p]),
    "sbr_model_report_unsupported": (c_uint32, [c_void_p, Report, c_void_p]),
    "sbr_model_report_scheme_bias": (c_uint32, [c_void_p, Report, c_void_p]),
    "sbr_default_world_definition": (WorldDefinition, []),
    "sbr_world_create": (c_int, [POINTER(WorldDefinition), POINTER(c_void_p), ERROR]),
    "sbr_world_destroy": (None, [W]),
    "sbr_world_step": (None, [W, c_double]),
    "sbr_world_get_state_hash": (c_uint64, [W]),
    "sbr_world_get_snapshot_size": (c_size_t, [W]),
    "sbr_world_save_snapshot": (c_int, [W, c_void_p, c_size_t]),
    "sbr_world_restore_snapshot": (c_int, [W, c_void_p, c_size_t]),
    "sbr_default_character_definition": (CharacterDefinition, []),
    "sbr_character_create": (c_int, [W, c_void_p, POINTER(CharacterDefinition), POINTER(CharacterId), ERROR]),
    "sbr_character_set_drive": (None, [W, C, c_float, c_float, c_float]),
    "sbr_character_set_vertical_speed": (None, [W, C, c_float]),
    "sbr_character_displace": (None, [W, C, Vec3, c_float]),
    "sbr_character_teleport": (None, [W, C, Double3, c_float]),
    "sbr_default_clip_play": (ClipPlay, []),
    "sbr_character_play_clip": (None, [W, C, c_uint32, c_int32, POINTER(ClipPlay)]),
    "sbr_character_get_origin": (Double3, [W, C]),
    "sbr_character_get_bones": (None, [W, C, POINTER(Transform), c_uint32]),
    "sbr_character_get_bone_scales": (c_uint32, [W, C, POINTER(Vec3), c_uint32]),
    "sbr_character_get_skin": (c_uint32, [W, C, c_uint32, FLOATS, FLOATS, FLOATS, c_uint32]),
    "sbr_character_get_surface": (c_uint32, [W, C, c_uint32, FLOATS, c_uint32]),
    "sbr_character_get_points": (c_uint32, [W, C, c_uint32, FLOATS, c_uint32]),
    "sbr_character_get_torn_polygons": (c_uint32, [W, C, c_uint32, c_uint32, POINTER(c_uint8), c_uint32]),
    "sbr_character_get_body_health": (BodyHealth, [W, C, c_uint32]),
    "sbr_character_get_element_visits": (c_uint32, [W, C, c_uint32]),
    "sbr_character_get_distance": (c_double, [W, C]),
}


@functools.lru_cache(maxsize=None)
def runtime_library():
    """The library that holds the runtime: the SDK's library if it includes it, else libsbrun. libsbrun is named by
    SBFMT_RUNTIME_LIBRARY, or is beside the SDK's library, or in the system's library folders."""
    loaded = library()
    if not hasattr(loaded, "sbr_model_create"):
        beside = os.path.join(os.path.dirname(library_path()), f"lib{NAME}.so*")
        for path in [os.environ.get("SBFMT_RUNTIME_LIBRARY"), *sorted(glob.glob(beside)), ctypes.util.find_library(NAME)]:
            if path:
                loaded = ctypes.CDLL(path)
                break
        else:
            raise ImportError(f"lib{NAME} is not found beside {library_path()}: let SBFMT_RUNTIME_LIBRARY name it")
    for name, (result, arguments) in CALLS.items():
        function = getattr(loaded, name)
        function.restype, function.argtypes = result, arguments
    return loaded


def floats(numbers):
    """A ctypes array of the numbers of any sequence or numpy array."""
    if hasattr(numbers, "astype"):
        data = numbers.astype("f4").tobytes()
        return (c_float * (len(data) // 4)).from_buffer_copy(data)
    return (c_float * len(numbers))(*numbers)


# ---- Grounds ----

def flat(height=0.0):
    """Level ground."""
    return runtime_library().sbr_ground_flat(height)


class GroundMesh:
    """Ground of triangles; beyond them its height is `otherwise`. `points` is flat: x, y, z of each."""

    def __init__(self, points, triangles, otherwise=0.0):
        self.points = floats(points)
        self.triangles = (c_uint32 * len(triangles))(*triangles)
        made, error = c_void_p(), DiagnosticStruct()
        check(runtime_library().sbr_ground_mesh_create(None, self.points, len(self.points) // 3, self.triangles,
                                                       len(self.triangles) // 3, otherwise, byref(made), byref(error)), error)
        self.pointer = made.value
        self.close = weakref.finalize(self, runtime_library().sbr_ground_mesh_destroy, self.pointer)

    @property
    def ground(self):
        return runtime_library().sbr_ground_from_mesh(self.pointer)

    def height_at(self, x, z):
        """m."""
        return self.ground.height_at(x, z)


# ---- Models and worlds ----

class Model:
    """Data that all characters of a built asset share. `scheme` is one of SCHEMES. `substeps` 0: as many as it needs.
    `detail_levels`: with all its detail levels (sbfmt.detail)."""

    def __init__(self, asset, level=0, scheme="automatic", substeps=0, free=False, gravity=None, detail_levels=False):
        if scheme not in SCHEMES:
            raise ValueError(f"scheme is one of {', '.join(SCHEMES)}, not {scheme!r}")
        options = runtime_library().sbr_default_model_options()
        options.level, options.scheme, options.substeps, options.free = level, SCHEMES.index(scheme), substeps, free
        options.has_gravity, options.gravity = gravity is not None, Vec3(*(gravity or (0, 0, 0)))
        options.detail_levels = detail_levels
        made, error = c_void_p(), DiagnosticStruct()
        check(runtime_library().sbr_model_create(asset.pointer, byref(options), byref(made), byref(error)), error)
        self.asset, self.pointer = asset, made.value
        self.close = weakref.finalize(self, runtime_library().sbr_model_destroy, self.pointer)

    def _findings(self, call):
        found = []
        report = Report(lambda _user, one: found.append(diagnostic_of(one.contents)))
        call(self.pointer, report, None)
        return found

    def left_out(self):
        """Parts of the asset that the runtime ignores: a list of Diagnostic."""
        return self._findings(runtime_library().sbr_model_report_unsupported)

    def scheme_warnings(self):
        """Bodies whose scheme is known to have an energy error above 10 %: a list of Diagnostic."""
        return self._findings(runtime_library().sbr_model_report_scheme_bias)


class World:
    """Simulates characters on a ground: `flat`, or a GroundMesh. `capacity` is the largest number of characters, 0: 16."""

    def __init__(self, ground=None, gravity=None, sleep_after=0.5, capacity=0):
        definition = runtime_library().sbr_default_world_definition()
        self.ground, self.models, self.characters = ground, [], []
        if ground is not None:
            definition.ground = ground.ground if isinstance(ground, GroundMesh) else ground
        if gravity is not None:
            definition.has_gravity, definition.gravity = True, Vec3(*gravity)
        definition.sleep_after_s, definition.character_capacity = sleep_after, capacity
        made, error = c_void_p(), DiagnosticStruct()
        check(runtime_library().sbr_world_create(byref(definition), byref(made), byref(error)), error)
        self.pointer = made.value
        self._finalizer = weakref.finalize(self, runtime_library().sbr_world_destroy, self.pointer)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Frees it and its characters now, without waiting for Python's garbage collection."""
        self._finalizer()
        self.pointer, self.characters, self.models = None, [], []

    def add(self, model, position=(0, 0, 0), heading=0.0, scale=1.0, hold_pose=False, detail_level=0):
        """Adds a character. The height of its position is relative to the ground. A distant character may start on a coarse detail level
        (detail.py)."""
        definition = runtime_library().sbr_default_character_definition()
        definition.position, definition.heading = Double3(*position), heading
        definition.scale, definition.hold_pose, definition.detail_level = scale, hold_pose, detail_level
        made, error = CharacterId(), DiagnosticStruct()
        check(runtime_library().sbr_character_create(self.pointer, model.pointer, byref(definition), byref(made), byref(error)), error)
        self.models.append(model)
        self.characters.append(Character(self, made))
        return self.characters[-1]

    def step(self, seconds):
        runtime_library().sbr_world_step(self.pointer, seconds)

    def state_hash(self):
        return runtime_library().sbr_world_get_state_hash(self.pointer)

    def snapshot(self):
        """The complete state as bytes for `restore`."""
        size = runtime_library().sbr_world_get_snapshot_size(self.pointer)
        kept = ctypes.create_string_buffer(size)
        runtime_library().sbr_world_save_snapshot(self.pointer, kept, size)
        return kept

    def restore(self, kept):
        """Restores a snapshot of this world with the same characters; False if it is of another world."""
        return runtime_library().sbr_world_restore_snapshot(self.pointer, kept, len(kept)) == 0


class Character:
    """One character of a world, which must be open."""

    def __init__(self, world, identity):
        self._world, self._id = world, identity

    def call(self, name, *arguments):
        return getattr(runtime_library(), name)(self._world.pointer, self._id, *arguments)

    def drive(self, forward=0.0, sideways=0.0, turn=0.0, up=0.0):
        """Sets the target speeds in m/s and rad/s. Left is positive; `up` is for characters that swim or fly."""
        self.call("sbr_character_set_drive", forward, sideways, turn)
        self.call("sbr_character_set_vertical_speed", up)

    def displace(self, by, turn=0.0):
        """Moves and turns it in the next tick, in m and rad. Its feet follow in steps."""
        self.call("sbr_character_displace", Vec3(*by), turn)

    def teleport(self, position, heading):
        self.call("sbr_character_teleport", Double3(*position), heading)

    def play(self, clip, layer=0, weight=1.0, fade=0.0, speed=1.0, start=0.0):
        """Plays a clip of the asset by its index; NONE fades the layer out."""
        how = runtime_library().sbr_default_clip_play()
        how.weight, how.fade_s, how.speed, how.start_s = weight, fade, speed, start
        self.call("sbr_character_play_clip", layer, clip, byref(how))

    @property
    def origin(self):
        found = self.call("sbr_character_get_origin")
        return (found.x, found.y, found.z)

    @property
    def distance(self):
        """m travelled."""
        return self.call("sbr_character_get_distance")

    def read(self, name, number, *more):
        count = self.call(name, number, None, *more, 0)
        found = (c_float * (3 * count))()
        self.call(name, number, found, *more, count)
        return found

    def skin(self, render_mesh):
        """Vertices of a render mesh, three floats each."""
        return self.read("sbr_character_get_skin", render_mesh, None, None)

    def surface(self, soft_body):
        """Vertices of a soft body's surface, three floats each."""
        return self.read("sbr_character_get_surface", soft_body)

    def points(self, soft_body):
        """Points of a soft body's simulated level, three floats each."""
        return self.read("sbr_character_get_points", soft_body)

    def torn(self, render_mesh):
        """For each polygon of a render mesh whether it spans a tear. Such polygons must not be drawn."""
        count = self.call("sbr_character_get_torn_polygons", render_mesh, 0, None, 0)
        found = (c_uint8 * count)()
        self.call("sbr_character_get_torn_polygons", render_mesh, 0, found, count)
        return found

    def bones(self, count):
        """The first `count` bones of the asset: an array of Transform."""
        found = (Transform * count)()
        self.call("sbr_character_get_bones", found, count)
        return found

    def bone_scales(self, count):
        """The scale of the first `count` bones along their own axes: an array of 3 numbers each."""
        found = (Vec3 * count)()
        self.call("sbr_character_get_bone_scales", found, count)
        return found

    def health(self, soft_body):
        return self.call("sbr_character_get_body_health", soft_body)

    def passes(self, soft_body):
        """Element visits of a soft body so far: the cost of its motion, independent of the machine."""
        return self.call("sbr_character_get_element_visits", soft_body)

"""Applies forces to soft bodies, drags their vertices and measures them: the functions of sbrun/soft_body.h.

    from sbfmt import runtime, soft_body
    with runtime.World(runtime.flat(0.0)) as world:
        lizard = world.add(runtime.Model(asset))
        vertex = soft_body.nearest_vertex(lizard, 0, (0, 0.2, 0.5))
        soft_body.grab(lizard, 0, vertex, (0, 0.6, 0.5))
        for _ in range(60):
            world.step(1 / 60)
        print(soft_body.grab_force(lizard, 0, vertex), soft_body.pin_reactions(lizard, 0))

Units are metres, newtons, newton-seconds and rad/s, in world space. Returned positions are relative to `Character.origin`. A call that
the runtime rejects raises sbfmt.Error. A vertex is a vertex of the body's surface; WHOLE_BODY means all points.
"""

import collections
import ctypes
import functools
from ctypes import POINTER, Structure, byref, c_bool, c_float, c_int, c_int32, c_uint32

from .library import DiagnosticStruct, check
from .runtime import C, ERROR, Double3, Vec3, W, runtime_library

WHOLE_BODY = 0xFFFFFFFF

# Mass (kg), and the free points' motion as one rigid body: centre of mass (m), velocity (m/s), angular velocity (rad/s).
Motion = collections.namedtuple("Motion", "mass center velocity angular_velocity")
# One pin set: its bone and rigid body (-1: none), its points, their mean position (m), force (N) and torque (N m) on the body.
PinReaction = collections.namedtuple("PinReaction", "pin_set bone rigid_body points about force torque")


class MotionStruct(Structure):
    _fields_ = [("mass", c_float), ("center", Vec3), ("velocity", Vec3), ("angular_velocity", Vec3)]


class VertexGrabStruct(Structure):
    _fields_ = [("cookie", c_uint32), ("target", Double3), ("frequency_hz", c_float), ("damping_ratio", c_float), ("max_force", c_float)]


class PinReactionStruct(Structure):
    _fields_ = [("pin_set", c_uint32), ("bone", c_int32), ("rigid_body", c_int32), ("points", c_uint32), ("about", Vec3), ("force", Vec3),
                ("torque", Vec3)]


class Tetrahedron(Structure):
    """Stress in Pa (xx, yy, zz, xy, yz, zx), strain energy per volume at rest in J/m^3, m^3, a ratio, and points of the level."""

    _fields_ = [("stress", c_float * 6), ("energy_density", c_float), ("rest_volume", c_float), ("volume_ratio", c_float),
                ("corners", c_uint32 * 4), ("torn", c_bool)]


class Spring(Structure):
    """Points of the level, tension in N (negative: compression), energy in J."""

    _fields_ = [("ends", c_uint32 * 2), ("tension", c_float), ("energy", c_float), ("torn", c_bool)]


# Tests compare their sizes with the headers.
STRUCTS = {"sbr_soft_motion": MotionStruct, "sbr_vertex_grab": VertexGrabStruct, "sbr_pin_reaction": PinReactionStruct,
           "sbr_tetrahedron_state": Tetrahedron, "sbr_spring_state": Spring}

BODY, VERTEX = c_uint32, c_uint32
CALLS = {
    "sbr_character_get_soft_motion": (MotionStruct, [W, C, BODY]),
    "sbr_character_set_soft_velocity": (c_int, [W, C, BODY, Vec3, Vec3, ERROR]),
    "sbr_character_apply_soft_impulse": (c_int, [W, C, BODY, VERTEX, Vec3, ERROR]),
    "sbr_character_apply_soft_force": (c_int, [W, C, BODY, VERTEX, Vec3, c_float, ERROR]),
    "sbr_default_vertex_grab": (VertexGrabStruct, []),
    "sbr_character_grab_vertex": (c_int, [W, C, BODY, VERTEX, POINTER(VertexGrabStruct), ERROR]),
    "sbr_character_release_vertex": (c_bool, [W, C, BODY, VERTEX]),
    "sbr_character_get_grab_force": (Vec3, [W, C, BODY, VERTEX]),
    "sbr_character_find_nearest_vertex": (c_uint32, [W, C, BODY, Double3]),
    "sbr_character_get_pin_reactions": (c_uint32, [W, C, BODY, POINTER(PinReactionStruct), c_uint32]),
    "sbr_character_get_tetrahedra": (c_uint32, [W, C, BODY, POINTER(Tetrahedron), c_uint32]),
    "sbr_character_get_springs": (c_uint32, [W, C, BODY, POINTER(Spring), c_uint32]),
}


@functools.lru_cache(maxsize=None)
def _library():
    loaded = runtime_library()
    for name, (result, arguments) in CALLS.items():
        function = getattr(loaded, name)
        function.restype, function.argtypes = result, arguments
    return loaded


def _ask(name, character, *arguments):
    _library()
    return character.call(name, *arguments)


def _do(name, character, *arguments):
    error = DiagnosticStruct()
    check(_ask(name, character, *arguments, byref(error)), error)


def _list(name, kind, character, body):
    count = _ask(name, character, body, None, 0)
    found = (kind * count)()
    _ask(name, character, body, found, count)
    return found


def _numbers(vector):
    return (vector.x, vector.y, vector.z)


def motion(character, body):
    """Mass and rigid motion of a body's free points; zeros where it is not simulated."""
    found = _ask("sbr_character_get_soft_motion", character, body)
    return Motion(found.mass, _numbers(found.center), _numbers(found.velocity), _numbers(found.angular_velocity))


def set_velocity(character, body, velocity, angular_velocity=(0, 0, 0)):
    """Sets the rigid motion of a body, in m/s and rad/s; its deformation is unchanged."""
    _do("sbr_character_set_soft_velocity", character, body, Vec3(*velocity), Vec3(*angular_velocity))


def apply_impulse(character, body, impulse, vertex=WHOLE_BODY):
    """Applies an impulse in N s at a vertex, or to the whole body."""
    _do("sbr_character_apply_soft_impulse", character, body, vertex, Vec3(*impulse))


def apply_force(character, body, force, seconds, vertex=WHOLE_BODY):
    """Applies a constant force in N for `seconds`, at a vertex or to the whole body."""
    _do("sbr_character_apply_soft_force", character, body, vertex, Vec3(*force), seconds)


def grab(character, body, vertex, target, frequency_hz=0.0, damping_ratio=1.0, max_force=0.0):
    """Pulls a vertex to a target (world, m) until it is released. Another call moves the target. 0: the runtime's defaults."""
    how = _library().sbr_default_vertex_grab()
    how.target = Double3(*target)
    how.frequency_hz, how.damping_ratio, how.max_force = frequency_hz, damping_ratio, max_force
    _do("sbr_character_grab_vertex", character, body, vertex, byref(how))


def release(character, body, vertex):
    """Releases a vertex; False if it was not held."""
    return _ask("sbr_character_release_vertex", character, body, vertex)


def grab_force(character, body, vertex):
    """Force on a held vertex in N, mean of the last tick."""
    return _numbers(_ask("sbr_character_get_grab_force", character, body, vertex))


def nearest_vertex(character, body, position):
    """Vertex of the body's surface nearest to a position (world, m); WHOLE_BODY if it has no surface."""
    return _ask("sbr_character_find_nearest_vertex", character, body, Double3(*position))


def pin_reactions(character, body):
    """Force and torque of each pin set on the body: a list of PinReaction."""
    return [PinReaction(one.pin_set, one.bone, one.rigid_body, one.points, _numbers(one.about), _numbers(one.force), _numbers(one.torque))
            for one in _list("sbr_character_get_pin_reactions", PinReactionStruct, character, body)]


def tetrahedra(character, body):
    """Stress, energy and volume of the simulated level's tetrahedra: an array of Tetrahedron, empty if it has none."""
    return _list("sbr_character_get_tetrahedra", Tetrahedron, character, body)


def springs(character, body):
    """Tension and energy of the simulated level's springs: an array of Spring, empty if it has none."""
    return _list("sbr_character_get_springs", Spring, character, body)

/* What the editor's help says. docs/godot.md says the same at more length. */
#include "class_help.h"
#include "soft_character.h"

static const gd_help character_words[] = {
    {"asset", "The character. Several nodes share one, and what is made of it."},
    {"paused", "It keeps still, and costs nothing. A node that does not process, as in a paused tree, keeps "
               "still too."},
    {"preview", "It also moves in the editor, and is put back when this is switched off. A scene is saved "
                "with the node where it stood before."},
    {"forward_speed", "The speed that it walks at to its front, in m/s; below 0 to its back. Its gait may be "
                      "slower than what is asked. See [method drive]."},
    {"sideways_speed", "The speed that it walks at to its left, in m/s; below 0 to its right."},
    {"turn_speed", "How fast it turns to its left, in rad/s; below 0 to its right. Rotating the node instead "
                   "puts it there at once."},
    {"vertical_speed", "How fast it rises, in m/s; below 0 sinks. Only what swims or flies does."},
    {"scheme",
        "How its soft bodies are stepped. Automatic is the file's own choice, and the best one to begin "
        "with."},
    {"substeps", "Steps a control tick, which is 1/60 s unless the file says otherwise. 0 is the file's own "
                 "choice. More cost as much more, and bear stiffer flesh."},
    {"level", "Which level of detail of the file is stepped: 0 is the finest; beyond the last is the last."},
    {"gravity_scale", "Times the file's gravity. That of the project and of its areas does not matter."},
    {"free_bodies", "Pins are dropped: sections fall apart from the bones."},
    {"hold_pose", "Bones stay in their rest pose, and flesh alone moves."},
    {"use_threads", "Steps on the [WorkerThreadPool]. The motion is the same to the bit."},
    {"mirror_skeleton", "A [Skeleton3D] under the node has the bones, for attachments. It follows the "
                        "character; posing it does not. See [method get_skeleton]."},
    {"ground", "What it stands on: bodies of the physics space, or a level plane at the height where it "
               "begins."},
    {"teleport_distance", "Metres. A node that a script or a parent moves farther in a frame is put there at "
                          "once; what is nearer it walks, and its feet step after it. 0 is half its size."},
    {"collision_mask", "Physics layers of the ground and of the bodies that it meets. It is on no layer "
                       "itself: areas and rays do not find it."},
    {"push_bodies", "A [RigidBody3D] that it touches is pushed with what the flesh feels."},
    {"push_limit", "By how many m/s the push of a frame makes a body faster at most; what came faster is "
                   "still thrown back. 0 is no bound."},
    {"meet_others", "It meets the other nodes of its physics space that have this too; parts of it meet each "
                    "other then. It costs."},
    {"material_override",
        "What all its meshes are drawn with instead of the file's materials. For a material "
        "of one surface see [method get_mesh_instance]."},
    {"cast_shadow", "Whether its meshes cast shadows."},
    {"layers", "Render layers of its meshes, for cameras and lights."},
    {"drive",
        "Sets [member forward_speed], [member sideways_speed] and [member turn_speed]: m/s, m/s, rad/s."},
    {"teleport", "Puts it over a place, turned by [param heading] radians about +Y: what walks stands on the "
                 "ground there, what is loose falls to it. The pose is kept."},
    {"reset_pose", "Puts it into its rest pose, where it stands."},
    {"play", "Plays the file's clip of that name, faded in over [param fade] seconds. See [method "
             "SoftAsset.get_clip_names]."},
    {"knock_over", "It falls, lies, and gets up again if it has legs. See [signal landed]."},
    {"get_travelled", "Metres that it has gone."},
    {"get_leg_count", "Legs of its gait."},
    {"is_leg_planted", "Whether that leg stands on the ground."},
    {"get_skin", "The vertices of one of its render meshes, in world space. See [method "
                 "SoftAsset.get_render_mesh_names]."},
    {"get_volume_ratio",
        "A soft body's volume as a share of that at rest. See [method SoftAsset.get_soft_body_names]."},
    {"get_max_strain", "The greatest strain in a soft body; 0 at rest."},
    {"is_asleep", "Whether a soft body is at rest, and costs nothing."},
    {"get_soft_mass", "Mass in kg of a soft body's free points; 0 where it is not simulated."},
    {"get_soft_velocity", "Velocity in m/s of a soft body's centre of mass."},
    {"get_soft_angular_velocity", "Angular velocity in rad/s of a soft body as a whole."},
    {"set_soft_velocity",
        "Sets the motion of a soft body as a whole, in m/s and rad/s. Its deformation keeps its own."},
    {"apply_soft_impulse",
        "Applies an impulse in N s at a vertex of a soft body's surface; -1: to the whole body."},
    {"apply_soft_force",
        "Applies a constant force in N for so many seconds at a vertex; -1: to the whole body."},
    {"get_nearest_vertex",
        "The vertex of a soft body's surface nearest to a position in world space; -1: it has none."},
    {"hold_vertex", "Draws a vertex to a position in world space until [method release_vertex]. Call it "
                    "again to move the position."},
    {"release_vertex", "Releases a vertex; false where it was not held."},
    {"get_hold_force", "Force in N on a held vertex."},
    {"get_pin_reactions",
        "Force in N and torque in N m that each pin set exerts on a soft body, one after the other."},
    {"get_stress", "Cauchy stress in Pa of each tetrahedron: xx, yy, zz, then xy, yz, zx. Empty where a soft "
                   "body has none."},
    {"get_substeps_needed", "Substeps that its bodies need now to be stable."},
    {"get_state_hash", "A hash of all that moves: equal where two runs are equal to the bit."},
    {"get_skeleton", "The [Skeleton3D] with its bones, or null. See [member mirror_skeleton]."},
    {"get_mesh_instance",
        "The [MeshInstance3D] that draws one of its render meshes, or null. It is made anew "
        "with the character: see [method SoftAsset.get_render_mesh_names]."},
    {"get_rest_bounds", "The box that it fills at rest, in the node's space."},
    {"get_bone_lines", "Head and tail of every bone, in world space."},
    {"foot_down", "A foot of the gait comes down."},
    {"foot_up", "A foot of the gait lifts."},
    {"landed", "Knocked over, it has come to lie and begins to get up, there."},
    {"contact", "A body begins to touch something: [param with] is the physics body or the other character, "
                "null for the "
                "ground; [param soft_body] is -1 for a rigid part; [param impulse] is in N s."},
    {"torn", "An element of a soft body tore."},
    {"SCHEME_AUTOMATIC", "The file's own choice."},
    {"SCHEME_SYMPLECTIC", "Symplectic Euler: the cheapest for most soft bodies."},
    {"SCHEME_POSITION_BASED", "Position-based with compliance, in small steps: stiff bodies, limits."},
    {"SCHEME_RELAXATION", "Verlet with a stiffness fraction and a damping factor a tick."},
    {"SCHEME_EXPLICIT_EULER", "Explicit Euler, to compare with: it gains energy."},
    {"SCHEME_HEUN", "Heun's, with steps as short as its error asks for."},
    {"SCHEME_BLOCK_DESCENT", "Vertex block descent: stiff bodies of tetrahedra."},
    {"GROUND_PHYSICS", "What stands still in the physics space, by rays."},
    {"GROUND_FLAT", "A plane at the height where the node began."},
    {0},
};

static const gd_help asset_words[] = {
    {"data", "The bytes of a .sbfz. Characters take other content up at once, and go on where they were if "
             "its structure is the same."},
    {"get_bone_names", "Names of its bones."},
    {"get_soft_body_names",
        "Names of its soft bodies, in the order that calls of [SoftCharacter3D] count them in."},
    {"get_render_mesh_names", "Names of its render meshes, likewise."},
    {"get_clip_names", "Names of its clips, for [method SoftCharacter3D.play]."},
    {"get_left_out", "What of the file is not acted on, a sentence each."},
    {0},
};

void words_set_help(void) {
  gd_class_set_help(&soft_character_class,
      "A soft character that walks, whose flesh gives and whose feet find the ground. It shows a [SoftAsset] "
      "and "
      "goes where its character goes; moving the node a little makes it step there, moving it far puts it "
      "there, scaling it makes it anew in "
      "that "
      "size. Physics bodies are its floors and walls; platforms that move carry it, light bodies are pushed; "
      "what hangs below the node, as a hit box does, is neither.",
      character_words);
  gd_class_set_help(&soft_asset_class,
      "A soft character's bundle, as [SoftCharacter3D] shows it. It is loaded from a .sbfz, or imported from "
      "a .sbf by the add-on's plugin.",
      asset_words);
}

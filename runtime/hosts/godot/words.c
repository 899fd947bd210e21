/* Texts of the editor's help; docs/godot.md has more. */
#include "class_help.h"
#include "soft_character.h"

static const gd_help character_words[] = {
    {"asset", "The character. Several nodes can share one asset and its model."},
    {"paused",
        "Stops the character, without cost. A node that does not process, as in a paused tree, stops too."},
    {"preview", "Runs the character in the editor; switching it off puts it back. A saved scene has the "
                "node's position from before."},
    {"forward_speed",
        "Wanted forward speed in m/s; negative: backward. The gait may be slower. See [method drive]."},
    {"sideways_speed", "Wanted speed to the left in m/s; negative: to the right."},
    {"turn_speed", "Wanted turn rate to the left in rad/s; negative: to the right. Rotating the node moves "
                   "it at once instead."},
    {"vertical_speed",
        "Wanted vertical speed in m/s of a swimmer or flier; negative: down. Other characters ignore it."},
    {"velocity", "Velocity in m/s, world axes, at which [method move_and_slide] moves it."},
    {"max_turn_speed",
        "Rate in rad/s at which [method move_and_slide] turns its front to [member velocity]; 0: it keeps "
        "its heading."},
    {"pose_source",
        "A [Skeleton3D] that an [AnimationPlayer] or [AnimationTree] drives: bones of the same names take "
        "its "
        "pose, and the soft bodies follow. Walking legs and tails keep their own motion, and clips are in "
        "layers 0 to 2."},
    {"pose_weight", "How much of the pose of [member pose_source] is taken, 0 to 1."},
    {"scheme", "Integration scheme of the soft bodies. Automatic is the file's own choice and the best to "
               "begin with."},
    {"substeps", "Substeps in a control tick (1/60 s unless the file says otherwise). 0 is the file's own "
                 "choice. Cost is proportional; stiffer bodies need more."},
    {"level", "Level of detail of the file that is simulated: 0 is the finest; numbers beyond the last mean "
              "the last."},
    {"detail",
        "Whether the level follows the size on the screen: coarser levels, bones alone, or, out of view, "
        "the path alone. Without a camera, and near a [RigidBody3D], it is the finest. Project settings: "
        "sbfmt/detail/error_pixels (0.5), sbfmt/detail/budget_ms (0: none)."},
    {"gravity_scale", "Factor on the file's gravity. The project's gravity and that of areas are not used."},
    {"free_bodies", "Removes all pins: sections fall off the bones."},
    {"hold_pose", "Keeps the bones in their rest pose; only soft bodies move."},
    {"use_threads", "Steps on the [WorkerThreadPool]. The motion is the same to the bit."},
    {"mirror_skeleton", "Adds a [Skeleton3D] under the node that follows the character, for attachments. "
                        "Posing it has no effect. See [method get_skeleton]."},
    {"ground", "What the character stands on: bodies of the physics space, or a level plane at the node's "
               "initial height."},
    {"teleport_distance",
        "Metres. A node that moves farther in one frame, by a script or its parent, takes the character "
        "there at once. Smaller motion makes it step there. 0 is half of its size."},
    {"collision_mask", "Physics layers of the ground and of the bodies that it collides with."},
    {"collision_layer",
        "Physics layers of its parts: one kinematic body, with a convex shape for each bone or soft "
        "body. Areas, rays, queries and other bodies meet it. See [method get_bone_of_shape]. 0 is "
        "none, without cost."},
    {"input_ray_pickable",
        "Whether the mouse picks it: [signal input_event]. An area on layer 32 stands in for it."},
    {"push_bodies", "A [RigidBody3D] in contact gets the soft bodies' impulses."},
    {"push_limit", "Greatest change of a body's velocity by the impulses of one frame, in m/s. A body that "
                   "arrives faster still bounces off. 0 is no limit."},
    {"meet_others", "Enables contacts with other nodes of the physics space that have this set, and between "
                    "parts of this character. It costs time."},
    {"material_override",
        "Material of all meshes instead of the file's. For one surface see [method get_mesh_instance]."},
    {"surface_materials",
        "Materials of single surfaces: the key is the name of a render mesh, a slash and the number of "
        "its surface, as Head/0. They are kept when the character is created again."},
    {"cast_shadow", "Whether the meshes cast shadows."},
    {"layers", "Render layers of the meshes, for cameras and lights."},
    {"drive",
        "Sets [member forward_speed], [member sideways_speed] and [member turn_speed]: m/s, m/s, rad/s."},
    {"teleport", "Moves the character to a position, with [param heading] in radians about +Y. A walker "
                 "stands on the ground there; loose bodies fall to it. The pose is kept."},
    {"reset_pose", "Puts the character into its rest pose at its position."},
    {"play", "Plays the clip of that name below the gait; an empty name fades it out. [param options] is a "
             "dictionary: "
             "loop (else the file's), speed (1), blend (seconds), weight (1), mask (of [method "
             "SoftAsset.get_bone_mask_names]), layer (0 to 3, higher ones over lower ones), "
             "root_motion (the body bone's motion along the ground moves a walking character); or the "
             "seconds of the blend."},
    {"queue", "Plays a clip when that of its layer ends; at most 8 wait. See [method play]."},
    {"get_current_clip",
        "Name of the clip that a layer plays; empty: none, or it has ended. Without a number layer 0."},
    {"get_clip_position", "Seconds into the clip of a layer."},
    {"set_ik_target",
        "Draws the end of an ik_chain, by the bone's or the chain's name, to a place in world space, until "
        "[method clear_ik_target]. The weight is 0 to 1, by default 1. It acts on walking legs too."},
    {"set_look_target",
        "Turns the front of a bone, as the head, to a point in world space, by at most 69 degrees, until "
        "[method clear_look_target]. The weight is 0 to 1, by default 1."},
    {"clear_look_target", "The bone turns back to its animation."},
    {"clear_ik_target", "The limb follows its animation again."},
    {"move_and_slide",
        "Moves it at [member velocity] for a physics frame: its feet step after it, floors carry it, and "
        "walls keep it out. Up and down is for those that swim or fly. Whether something was in its way "
        "in the last frame. Call it in _physics_process."},
    {"get_real_velocity", "Velocity in m/s at which the node moved in the last physics frame."},
    {"knock_over", "Makes the character fall. If it has legs, it gets up again. See [signal landed]."},
    {"get_travelled", "Distance travelled, in metres."},
    {"get_detail_level", "Its present level of detail: 0 is the finest. See [member detail]."},
    {"get_leg_count", "Number of legs of the gait."},
    {"is_leg_planted", "Whether that leg stands on the ground."},
    {"get_skin", "Vertices of a render mesh in world space. See [method SoftAsset.get_render_mesh_names]."},
    {"get_volume_ratio",
        "Volume of a soft body relative to rest. See [method SoftAsset.get_soft_body_names]."},
    {"get_max_strain", "Greatest strain in a soft body; 0 at rest."},
    {"is_asleep", "Whether a soft body is asleep: at rest and without cost."},
    {"get_soft_mass", "Mass in kg of a soft body's free points; 0 where it is not simulated."},
    {"get_soft_velocity", "Velocity in m/s of a soft body's centre of mass."},
    {"get_soft_angular_velocity", "Angular velocity in rad/s of a soft body as a whole."},
    {"set_soft_velocity", "Sets the linear and angular velocity of a soft body as a whole, in m/s and rad/s. "
                          "Its deformation keeps its own motion."},
    {"apply_soft_impulse",
        "Applies an impulse in N s at a vertex of a soft body's surface; -1: to the whole body."},
    {"apply_soft_force",
        "Applies a constant force in N for so many seconds at a vertex; -1: to the whole body."},
    {"apply_impulse",
        "Applies an impulse in N s at the surface nearest to a position in world space, as a hit has it."},
    {"apply_force",
        "Applies a force in N there for one physics frame: call it in each. At most 8 forces and grabs act."},
    {"grab", "Grabs the surface nearest to a point in world space; whether it could. [method drag] "
             "moves it, "
             "[method release] lets go."},
    {"drag", "Pulls the grabbed vertex to a point in world space, with at most 20 times the body's weight."},
    {"release", "Releases the grabbed vertex."},
    {"is_grabbed", "Whether a vertex is grabbed."},
    {"get_nearest_vertex",
        "The vertex of a soft body's surface nearest to a position in world space; -1: it has none."},
    {"grab_vertex", "Pulls a vertex to a position in world space until [method release_vertex]. Call it "
                    "again to move the position."},
    {"release_vertex", "Releases a vertex; false where it was not held."},
    {"get_grab_force", "Force in N on a held vertex."},
    {"get_pin_reactions",
        "Force in N and torque in N m that each pin set exerts on a soft body, one after the other."},
    {"get_stress", "Cauchy stress in Pa of each tetrahedron: xx, yy, zz, then xy, yz, zx. Empty where a soft "
                   "body has none."},
    {"get_bone_of_shape",
        "Name of the bone that a shape of its body follows, as hits report shapes; empty: none."},
    {"get_soft_body_of_shape", "Number of the soft body that a shape of its body stands for; -1: none."},
    {"get_rid", "RID of its body in the physics space. See [member collision_layer]."},
    {"get_contacts",
        "Contacts of its soft bodies and simulated rigid bodies at present, each with soft_body, bone, "
        "position, normal, impulse and with, as [signal contact] has them; positions are those of the "
        "last strike."},
    {"get_substeps_needed", "Number of substeps that the bodies need now to be stable."},
    {"get_state_hash", "Hash of the simulation's state: equal if two runs are equal to the bit."},
    {"get_skeleton", "The [Skeleton3D] with its bones, or null. See [member mirror_skeleton]."},
    {"get_mesh_instance", "The [MeshInstance3D] of a render mesh, or null. It is recreated with the "
                          "character. See [method SoftAsset.get_render_mesh_names]."},
    {"get_rest_bounds", "Bounding box at rest, in the node's space."},
    {"get_bone_lines", "Head and tail of every bone, in world space."},
    {"foot_down", "A foot of the gait lands."},
    {"foot_up", "A foot of the gait lifts off."},
    {"landed",
        "The character has landed after a fall, or a knocked over one begins to get up at [param position]."},
    {"contact", "A body begins to touch something. [param with] is the physics body or the other character, "
                "null for the ground; [param soft_body] is -1 for a rigid part; [param impulse] is in N s."},
    {"input_event", "As [signal CollisionObject3D.input_event]. See [member input_ray_pickable]."},
    {"mouse_entered", "The mouse begins to point at it. See [member input_ray_pickable]."},
    {"mouse_exited", "The mouse no longer points at it."},
    {"contact_ended", "A contact ends; see [signal contact]."},
    {"struck", "Something strikes a body at more than 1 m/s: once a tick. See [signal contact]."},
    {"fell_asleep", "Soft bodies that hang together come to rest; [param soft_body] is the first of them."},
    {"woke", "Soft bodies that rested move again."},
    {"animation_finished",
        "A clip that does not loop has come to its end, where it stays. See [method play]."},
    {"fell", "It was knocked over."},
    {"rising", "It begins to get up. See [method knock_over]."},
    {"rose", "It stands again."},
    {"torn", "An element of a soft body tore."},
    {"SCHEME_AUTOMATIC", "The file's own choice."},
    {"SCHEME_SYMPLECTIC", "Symplectic Euler: the cheapest for most soft bodies."},
    {"SCHEME_POSITION_BASED", "Position-based with compliance, in small steps: stiff bodies, limits."},
    {"SCHEME_RELAXATION", "Verlet with a stiffness fraction and a damping factor a tick."},
    {"SCHEME_EXPLICIT_EULER", "Explicit Euler, for comparison: it gains energy."},
    {"SCHEME_HEUN", "Heun's method, with steps as short as its error requires."},
    {"SCHEME_BLOCK_DESCENT", "Vertex block descent: stiff bodies of tetrahedra."},
    {"DETAIL_AUTOMATIC", "As fine as the camera sees."},
    {"DETAIL_FULL", "The finest level always."},
    {"GROUND_PHYSICS", "The bodies of the physics space near the character."},
    {"GROUND_FLAT", "A plane at the node's initial height."},
    {0},
};

static const gd_help asset_words[] = {
    {"data", "The bytes of a .sbfz. Characters load new content at once and keep their state if its "
             "structure is the same."},
    {"get_bone_names", "Names of the bones."},
    {"get_soft_body_names",
        "Names of the soft bodies; their order gives the numbers in calls of [SoftCharacter3D]."},
    {"get_render_mesh_names",
        "Names of the render meshes; their order gives the numbers in calls of [SoftCharacter3D]."},
    {"get_clip_names", "Names of its clips, for [method SoftCharacter3D.play]."},
    {"get_bone_mask_names", "Names of its bone masks, for [method SoftCharacter3D.play]."},
    {"get_ik_chain_names", "Names of its chains of bones, for [method SoftCharacter3D.set_ik_target]."},
    {"get_left_out", "Parts of the file that are ignored, one sentence each."},
    {0},
};

void words_set_help(void) {
  gd_class_set_help(&soft_character_class,
      "A walking soft character with deformable bodies and feet that find the ground. It shows a "
      "[SoftAsset]. The "
      "node follows the character. Moving the node a little makes the character step there; moving it far "
      "takes it there "
      "at once; scaling it recreates the character at that size. Physics bodies are floors and walls. Moving "
      "platforms "
      "take it along, and light bodies are pushed. Bodies below the node, as a hit box, are ignored.",
      character_words);
  gd_class_set_help(&soft_asset_class,
      "The bundle of a soft character, for [SoftCharacter3D]. Load it from a .sbfz, or import it from a .sbf "
      "by the "
      "add-on's plugin.",
      asset_words);
}

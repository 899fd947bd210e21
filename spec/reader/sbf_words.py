"""The words of enumerations in their order, taken down from reference.md and kept by hand."""

WORDS_TEXT = """
mesh_target: rendering surface collision_detection
volume_target: volume
elastic_model: springs tetrahedra shape_matching jiggle
spring_kind: structural shear flexion internal cross_body
pressure_mode: none gas volume
body_motion: kinematic dynamic
joint_kind: prismatic revolute cylindrical spherical point_on_line point_in_plane distance pulley fixed six_dof
joint_axis: linear_x linear_y linear_z twist swing_y swing_z swing distance
attachment_rule: explicit inside_hull
weight_property: density young_modulus bending_stiffness mass_damping stiffness_damping friction pressure yield_strain tear_strain
scheme: automatic symplectic position_based relaxation explicit_euler heun block_descent
ik_solver: two_bone ccd fabrik damped_least_squares spline
gait_kind: walk swim fly slither crawl roll none
wave_plane: lateral vertical
fin_motion: flap trail steer
chain_kind: lag distance
follower_channel: rotation position both squash weight
bone_axis: x y z
chain_collider_shape: sphere capsule plane
track_property: translation rotation scale
interpolation: linear step cubic
field_kind: uniform radial vortex drag
alpha_mode: opaque mask blend
"""


def read_words(text):
    return {line.split(": ")[0]: line.split(": ")[1].split() for line in text.strip().splitlines()}


WORDS = read_words(WORDS_TEXT)

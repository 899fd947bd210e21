"""Which elements and fields there are, taken down from reference.md and kept by hand: this reader uses nothing of the
schema or from anything made of it, so that it can tell whether those say the same as the specification.

A line of ELEMENTS without indentation begins an element: its name, its other name in XML, its kind of part. A field's number is its
place. `as`: how XML writes children; `length`: of a list; `below`: what its items index; `since`: the minor version of its beginning.
"""

import re

from sbf_words import WORDS

ELEMENTS_TEXT = """
asset <sbf> ROOT
  version: string required
  info: one(info) as=<asset>
  derivations: many(derivation) as=<derivations><derivation>
  textures: many(texture) as=<textures><texture>
  materials: many(material) as=<materials><material>
  bones: many(bone) as=<skeleton><bone>
  rigid_bodies: many(rigid_body) as=<rigid_bodies><rigid_body>
  joints: many(joint) as=<joints>KIND_joint
  render_meshes: many(render_mesh) as=<render_mesh>
  soft_bodies: many(soft_body) as=<soft_body>
  cross_springs: many(cross_springs)
  ik_chains: many(ik_chain) as=<ik><ik_chain>
  gaits: many(gait) as=<gait>
  chains: many(chain) as=<chains><chain>
  followers: many(follower) as=<followers><follower>
  clips: many(clip) as=<clips><clip>
  poses: many(pose) as=<poses><pose>
  bone_masks: many(bone_mask) as=<bone_masks><bone_mask>
  retarget_chains: many(retarget_chain) as=<retarget_chains><retarget_chain>
  environment: one(environment)
  relaxation: one(relaxation)
  extensions: many(extension) as=<extensions><extension>
  section_recipes: many(section_recipe) as=<section_recipes><section_recipe>
  chain_colliders: many(chain_collider) as=<chain_colliders><chain_collider> since=4
info
  title: string
  licence: string
  copyright: string
  tool: string
  comment: string
  authors: many(author) as=<author>
  sources: many(source) as=<source>
  mass: float range=[0,inf)
  low: vec3
  high: vec3
author
  name: string required
  contact: string
source
  path: string required
  sha256: string
derivation
  id: id required
  tool: string
  settings: string
  source_hash: string
  mass: float range=[0,inf)
  low: vec3
  high: vec3
texture TXTR
  id: id required
  name: string
  path: string
  media_type: string
  bytes: bytes
material
  id: id required
  name: string
  base_color: vec4 default=1,1,1,1 range=[0,1]
  metallic: float default=0 range=[0,1]
  roughness: float default=1 range=[0,1]
  emissive: vec3 range=[0,inf)
  alpha_mode: enum(alpha_mode) default=opaque
  alpha_cutoff: float default=0.5 range=[0,1]
  double_sided: bool default=false
  base_color_texture: ref(textures)
  metallic_roughness_texture: ref(textures)
  normal_texture: ref(textures)
  base_color_uv: optional(uv_transform) since=1
  metallic_roughness_uv: optional(uv_transform) since=1
  normal_uv: optional(uv_transform) since=1
uv_transform
  offset: vec2
  rotation: float
  scale: vec2 default=1,1
bone
  id: id required
  name: string
  parent: ref(bones)
  head: vec3 required
  rotation: quat default=0,0,0,1
  length: float range=[0,inf)
  inherit_rotation: bool default=true
  inherit_scale: bool default=true
frame
  position: vec3
  rotation: quat default=0,0,0,1
rigid_body
  id: id required
  name: string
  bone: ref(bones)
  derived: ref(derivations)
  proposed: bool default=false
  motion: enum(body_motion) default=kinematic
  mass: float range=[0,inf)
  density: float default=1000 range=(0,inf)
  center: vec3
  inertia: vec3 range=[0,inf)
  inertia_rotation: quat default=0,0,0,1
  friction: float default=0.5 range=[0,inf)
  restitution: float default=0 range=[0,1]
  gravity_scale: float default=1
  layer: uint default=1
  mask: uint default=4294967295
  hull: optional(polygon_mesh) as=<polygon_mesh> fixed=target=collision_detection
  hull_derived: ref(derivations)
  velocity: vec3 since=3
  angular_velocity: vec3 since=3
joint
  id: id required
  name: string
  kind: enum(joint_kind) required
  body_a: ref(rigid_bodies)
  body_b: ref(rigid_bodies) required
  frame_a: one(frame)
  frame_b: one(frame)
  proposed: bool default=false
  collide: bool default=false
  limits: many(limit) as=<limits><limit>
  drives: many(drive) as=<drive>
  pulley_a: vec3
  pulley_b: vec3
  pulley_ratio: float default=1 range=(0,inf)
  break_force: float range=[0,inf)
  break_torque: float range=[0,inf)
  derived: ref(derivations)
limit
  target: enum(joint_axis) required
  min: float required
  max: float required
  stiffness: float range=[0,inf)
  damping: float range=[0,inf)
  restitution: float range=[0,1]
drive
  target: enum(joint_axis) required
  position: float
  velocity: float
  stiffness: float range=[0,inf)
  damping: float range=[0,inf)
  maximum: float range=[0,inf)
polygon_mesh
  target: enum(mesh_target) required
  positions: vec3[]
  polygon_sizes: uint[] range=[3,inf)
  polygon_points: uint[] length=sum(polygon_sizes) below=positions
render_mesh MESH
  id: id required
  name: string
  bone: ref(bones)
  derived: ref(derivations)
  mesh: one(polygon_mesh) as=<polygon_mesh> fixed=target=rendering
  normals: vec3[]
  normal_corners: uint[] length=0|mesh.polygon_points below=normals
  uv_sets: many(uv_set) as=<uv_set>
  material_slots: many(material_slot) as=<material_slot>
  polygon_materials: uint[] length=0|mesh.polygon_sizes below=material_slots
  skin: optional(skin)
  shape_keys: many(shape_key) as=<shape_key>
  source_points: uint[] length=0|mesh.positions
  levels: many(render_level) as=<render_level>
  pins: many(pin_set) as=<pins><pin_set>
  colors: vec4[] range=[0,1] since=1
  color_corners: uint[] length=0|mesh.polygon_points below=colors since=1
uv_set
  name: string
  coordinates: vec2[]
  corners: uint[] length=0|parent.mesh.polygon_points below=coordinates
material_slot
  material: ref(materials)
skin
  influence_counts: uint[] length=parent.mesh.positions
  bones: uint[] length=sum(influence_counts) below=asset.bones
  weights: float[] range=[0,1] length=bones
shape_key
  name: string required
  points: uint[] below=parent.size
  offsets: vec3[] length=points
render_level
  error: float range=[0,inf)
  polygon_sizes: uint[] range=[3,inf)
  polygon_points: uint[] length=sum(polygon_sizes) below=parent.mesh.positions
  derived: ref(derivations)
  polygon_materials: uint[] length=0|polygon_sizes below=parent.material_slots
  corners: uint[] length=0|polygon_points below=parent.mesh.polygon_points
soft_body BODY
  id: id required
  name: string
  bone: ref(bones)
  derived: ref(derivations)
  surface: one(polygon_mesh) as=<polygon_mesh> fixed=target=surface
  interior: vec3[]
  source_points: uint[] length=0|surface.positions
  attributes: one(attributes)
  collision: one(collision)
  weight_maps: many(weight_map) as=<weight_map>
  pins: many(pin_set) as=<pins><pin_set>
  attachments: many(attachment) as=<attachments><attachment>
  levels: many(level) as=<level>
  legacy: optional(legacy)
attributes
  density: float default=1000 range=(0,inf)
  mass: float range=[0,inf)
  area_density: float range=[0,inf)
  thickness: float default=0.001 range=(0,inf)
  young_modulus: float default=80000 range=(0,inf)
  poisson_ratio: float default=0.4 range=(-1,0.5)
  bending_stiffness: float range=[0,inf)
  mass_damping: float range=[0,inf)
  stiffness_damping: float range=[0,inf)
  damping_ratio: float default=0.2 range=[0,inf)
  friction: float default=0.6 range=[0,inf)
  restitution: float default=0 range=[0,1]
  gravity_scale: float default=1
  media_friction: float range=[0,inf)
  pressure: float
  pressure_mode: enum(pressure_mode) default=none
  strain_min: float default=-1 range=[-1,0]
  strain_max: float range=[0,inf)
  yield_strain: float range=[0,inf)
  yield_flow: float range=[0,inf)
  tear_strain: float range=[0,inf)
  sag_free: bool default=false
weight_map
  property: enum(weight_property) required
  values: float[] range=[0,inf) length=parent.size
collision
  particle_radius: float default=0.01 range=[0,inf)
  outer_thickness: float default=0.005 range=[0,inf)
  inner_thickness: float default=0.01 range=[0,inf)
  self: bool default=false
  layer: uint default=1
  mask: uint default=4294967295
pin_set
  name: string
  bone: ref(bones)
  rigid_body: ref(rigid_bodies)
  derived: ref(derivations)
  points: uint[] below=parent.size
  offsets: vec3[] length=0|points
  weights: float[] range=[0,1] length=0|1|points
  stiffness: float range=[0,inf)
  damping: float range=[0,inf)
  minimum: float range=[0,1]
  maximum: float default=1 range=[0,1]
attachment
  name: string
  rule: enum(attachment_rule) required
  rigid_body: ref(rigid_bodies) required
  points: uint[] below=parent.size
level LEVL
  name: string
  model: enum(elastic_model) default=springs
  derived: ref(derivations)
  cell: float range=[0,inf)
  positions: vec3[]
  new_from_old: uint[]
  masses: float[] range=[0,inf) length=0|positions
  lattice: one(tetrahedron_mesh) as=<tetrahedron_mesh>
  springs: many(spring_set) as=<spring_set>
  regions: optional(shape_regions) as=<shape_regions>
  jiggle: optional(jiggle)
  pins: many(pin_set) as=<pins><pin_set>
  embeddings: many(embedding) as=<embedding>
  simulation: one(simulation)
  calibration: optional(calibration)
tetrahedron_mesh
  target: enum(volume_target) required
  tetrahedra: uint4[] below=parent.positions
  young_modulus: float[] range=(0,inf) length=0|1|tetrahedra
  reference_modulus: float[] range=(0,inf) length=0|1|tetrahedra
  densities: float[] range=(0,inf) length=0|1|tetrahedra
  color_counts: uint[]
  stiffness_damping: float[] range=[0,inf) length=0|1|tetrahedra
spring_set
  name: string
  kind: enum(spring_kind) required
  derived: ref(derivations)
  extra: bool default=false
  ends: uint2[] below=parent.positions
  rest_lengths: float[] range=[0,inf) length=0|ends
  stiffness: float[] range=[0,inf) length=0|1|ends
  damping: float[] range=[0,inf) length=0|1|ends
  strain_min: float default=-1 range=[-1,0]
  strain_max: float range=[0,inf)
  yield_strain: float range=[0,inf)
  tear_strain: float range=[0,inf)
  inert_count: uint
  color_counts: uint[]
  compression_ratio: float[] range=[0,inf) length=0|1|ends
shape_regions
  sizes: uint[] range=[1,inf)
  points: uint[] length=sum(sizes) below=parent.positions
  stiffness: float default=60 range=(0,inf)
jiggle
  frequency: float default=3 range=(0,inf)
  damping_ratio: float default=0.4 range=[0,inf)
  response: float default=0
embedding
  render_mesh: ref(render_meshes)
  vertices: uint[]
  points: uint4[] below=parent.positions
  weights: vec4[] length=points
  blends: float[] range=[0,1] length=0|points
  derived: ref(derivations)
simulation
  scheme: enum(scheme) default=automatic
  substeps: uint
  error: float range=[0,inf)
  cost: float range=[0,inf)
  measured: many(measured)
  step_error: float range=[0,inf)
  substeps_least: uint
  substeps_most: uint
  motion_error: float range=[0,inf)
  motion_error_rms: float range=[0,inf)
calibration
  reference_elements: uint
  factor: float default=1 range=(0,inf)
  surface_factor: float default=1 range=(0,inf)
  residual: float range=[0,inf)
  period_error: float
  load_errors: float[]
  twist_errors: float[]
measured
  machine: string
  microseconds: float range=[0,inf)
legacy
  mass: float
  volume_stiffness: float
  stretching_stiffness: float
  friction: float
  particle_radius: float
  solver_iterations: uint
cross_springs
  name: string
  derived: ref(derivations)
  body_a: ref(soft_bodies) required
  level_a: uint
  body_b: ref(soft_bodies) required
  level_b: uint
  ends: uint2[]
  rest_lengths: float[] range=[0,inf) length=0|ends
  stiffness: float[] range=[0,inf) length=0|1|ends
  damping: float[] range=[0,inf) length=0|1|ends
ik_chain
  id: id required
  name: string
  solver: enum(ik_solver) default=two_bone
  root: ref(bones) required
  end: ref(bones) required
  has_pole: bool default=false
  pole: vec3
  pole_bone: ref(bones)
  copy_rotation: float default=1 range=[0,1]
  soft_reach: float default=0.02 range=[0,1)
  tolerance: float default=0.0001 range=(0,inf)
  iterations: uint default=32
  comforts: many(comfort) as=<comfort>
  proposed: bool default=false
comfort
  bone: ref(bones) required
  rotation: quat default=0,0,0,1
  weight: float default=1 range=[0,1]
  axes: vec3 default=1,1,1 range=[0,1]
gait GAIT
  id: id required
  name: string
  proposed: bool default=false
  body: ref(bones) required
  hips: ref(bones)
  chest: ref(bones)
  step_height: float default=0.05 range=[0,inf)
  step_width: float range=[0,inf)
  step_trigger: float default=0.05 range=(0,inf)
  step_duration: float default=0.25 range=(0,inf)
  walk_speed: float default=0.5 range=(0,inf)
  hip_tilt: float default=0.5 range=[0,1]
  body_tilt: float default=0.7 range=[0,1]
  legs: many(leg) as=<leg>
  head: optional(head_turn) as=<head_turn>
  tails: many(tail) as=<tail>
  kind: enum(gait_kind) default=walk since=2
  rest_pose: ref(poses) since=2
  idle_clip: ref(clips) since=2
  move_clip: ref(clips) since=2
  undulation: optional(undulation) as=<undulation> since=2
  fins: many(fin) as=<fin> since=2
  wheels: many(wheel) as=<wheel> since=2
  treads: many(tread) as=<tread> since=2
  medium: optional(medium) as=<medium> since=2
leg
  name: string
  ik: ref(ik_chains) required
  home: vec3 required
  sole: float
  group: uint
  jump_margin: float default=0.5 range=[0,inf)
head_turn
  bone: ref(bones) required
  lead: float default=0.4 range=[0,inf)
  limit: float default=0.7 range=[0,3.15]
  frequency: float default=1.5 range=(0,inf)
  damping_ratio: float default=0.8 range=[0,inf)
tail
  chain: ref(chains) required
  frequency: float default=1.2 range=(0,inf)
  damping_ratio: float default=0.25 range=[0,inf)
  limit: float default=0.6 range=[0,3.15]
undulation
  bones: uint[] below=asset.bones
  plane: enum(wave_plane) default=lateral
  length: float range=[0,inf)
  wavelength: float default=0.95 range=(0,inf)
  amplitude: vec3 default=0.02,-0.08,0.16
  exaggeration: float default=1 range=[0,10]
  strouhal_number: float default=0.3 range=(0,inf)
  idle_frequency: float default=0.4 range=[0,inf)
  max_frequency: float default=8 range=(0,inf)
  heading_amplitude: float default=0.7 range=[0,1.5]
fin
  name: string
  bones: uint[] below=asset.bones
  motion: enum(fin_motion) default=flap
  axis: vec3 default=0,0,1
  amplitude: float default=0.4 range=[0,3.15]
  mean: float range=[-3.15,3.15]
  flex: float range=[0,3.15]
  lag: float range=[0,6.29]
  phase: float range=[-6.29,6.29]
  frequency: float range=[0,60]
  twist: float range=[0,3.15]
wheel
  name: string
  bone: ref(bones) required
  axis: vec3 default=1,0,0
  radius: float required range=(0,inf)
  steer_limit: float range=[0,1.5]
tread
  name: string
  bones: uint[] below=asset.bones
medium
  buoyancy: float default=1 range=[0,10]
  drag_length: float range=[0,inf)
  altitude: float range=[0,inf)
  bank: float default=1 range=[0,4]
  bank_limit: float default=0.8 range=[0,1.5]
  pitch_limit: float default=0.8 range=[0,1.5]
  tilt: float range=[-1.5,1.5]
  bob: float range=[0,inf)
  bob_frequency: float default=0.8 range=[0,8]
  glide_ratio: float range=[0,inf)
chain
  id: id required
  name: string
  kind: enum(chain_kind) default=lag
  bones: uint[] below=asset.bones
  spacing: float[] range=[0,inf) length=0|bones
  angle_limit: float default=1 range=[0,3.15]
  damping: float range=[0,inf)
  proposed: bool default=false
  spring: optional(chain_spring) as=<chain_spring> since=4
chain_spring
  stiffness: float[] range=[0,inf) length=0|1|parent.bones
  drag: float[] range=[0,inf) length=0|1|parent.bones
  gravity: vec3[] length=0|1|parent.bones
  radius: float[] range=[0,inf) length=0|1|parent.bones
  center: ref(bones)
  colliders: uint[] below=asset.chain_colliders
chain_collider
  id: id required
  name: string
  bone: ref(bones) required
  shape: enum(chain_collider_shape) required
  position: vec3
  end: vec3
  normal: vec3 default=0,1,0
  radius: float range=[0,inf)
  inside: bool default=false
follower
  id: id required
  name: string
  bone: ref(bones) required
  channel: enum(follower_channel) default=rotation
  frequency: float default=2 range=(0,inf)
  damping_ratio: float default=0.5 range=[0,inf)
  response: float default=0
  axis: enum(bone_axis) default=y
  strength: float default=1 range=[0,inf)
  limit: float default=0.5 range=(0,inf)
clip CLIP
  id: id required
  name: string
  duration: float range=[0,inf)
  loop: bool default=true
  tracks: many(track) as=<track>
track
  bone: ref(bones) required
  property: enum(track_property) required
  interpolation: enum(interpolation) default=linear
  times: float[]
  values: float[]
pose
  id: id required
  name: string
  distance: float
  keys: many(pose_key) as=<pose_key>
  speed: float range=[0,inf)
  mirrored: bool default=false
pose_key
  bone: ref(bones) required
  translation: vec3
  rotation: quat default=0,0,0,1
bone_mask
  id: id required
  name: string
  bones: uint[] below=asset.bones
  weights: float[] range=[0,1] length=0|bones
retarget_chain
  id: id required
  name: string
  bones: uint[] below=asset.bones
environment
  gravity: vec3 default=0,-9.81,0
  wind: vec3
  media_density: float range=[0,inf)
  media_friction: float range=[0,inf)
  control_tick: float default=0.016666668 range=(0,1]
  fields: many(force_field) as=<force_field>
  has_water: bool default=false since=2
  water_level: float since=2
force_field
  id: id required
  name: string
  kind: enum(field_kind) required
  position: vec3
  direction: vec3
  strength: float
  radius: float range=[0,inf)
  falloff: float range=[0,inf)
relaxation
  stiffness: float default=0.3 range=[0,1]
  damping: float default=0.9 range=[0,1]
  gravity: float default=0.001
section_recipe
  bone: ref(bones)
  attributes: one(attributes)
  collision: one(collision)
  rigid: bool default=false since=2
  proposed: bool default=false since=2
  elements: uint default=0 since=3
extension
  name: string required
  required: bool default=false
  data: text
"""

KNOWN_VERSION = (1, 4)  # the version of the format that this reader knows
WIDTHS = {"vec2": 2, "vec3": 3, "vec4": 4, "quat": 4, "uint2": 2, "uint4": 4}
CHILDREN = ("one", "optional", "many")


class Field:
    """One field. `scalar` is float, uint, int or bytes for numbers, alone or in lists; `width` how many an item has."""

    def __init__(self, number, line):
        name, rest = line.strip().split(": ", 1)
        words = rest.split()
        options = dict(word.split("=", 1) for word in words[1:] if "=" in word)
        self.number, self.name = number, name
        kind, _, argument = words[0].rstrip(")").partition("(")
        self.is_list = kind.endswith("[]") or kind == "bytes"
        self.kind, self.argument = kind, argument
        base = kind[:-2] if kind.endswith("[]") else kind
        self.width = WIDTHS.get(base, 1)
        self.scalar = {"vec2": "float", "vec3": "float", "vec4": "float", "quat": "float", "uint2": "uint",
                       "uint4": "uint"}.get(base, base)
        self.required = "required" in words[1:]
        self.is_child = kind in CHILDREN
        self.is_attribute = not (self.is_child or self.is_list or kind == "text")
        self.written = re.findall(r"[A-Za-z_0-9]+", options.get("as", ""))
        self.default_text = options.get("default")
        self.lengths = options["length"].split("|") if "length" in options else []
        self.below = options.get("below")
        self.since = int(options.get("since", 0))
        self.fixed = tuple(options["fixed"].split("=")) if "fixed=" in line else None
        self.range = self.read_range(options["range"]) if "range" in options else None

    @staticmethod
    def read_range(text):
        low, high = text[1:-1].split(",")
        return float(low), float(high), text[0] == "(", text[-1] == ")"

    @property
    def wrapper(self):
        return self.written[0] if len(self.written) == 2 else None

    def default(self):
        """The value of a field that is not given; children are made by who asks."""
        text, kind = self.default_text, self.kind
        if self.is_list:
            return b"" if kind == "bytes" else []
        if kind in ("string", "text", "id"):
            return text or ""
        if kind == "ref":
            return None
        if kind == "enum":
            return text or WORDS[self.argument][0]
        if kind == "bool":
            return text == "true"
        numbers = [float(n) if self.scalar == "float" else int(n) for n in text.split(",")] if text else []
        numbers = numbers or ([0.0] * self.width if self.scalar == "float" else [0] * self.width)
        return numbers if self.width > 1 else numbers[0]


class Element:
    """One element: its fields in the order of their numbers."""

    def __init__(self, line):
        words = line.split()
        self.name, self.fields, self.by_name, self.by_number = words[0], [], {}, {}
        self.xml = next((word[1:-1] for word in words[1:] if word[0] == "<"), self.name)
        self.part = next((word for word in words[1:] if word[0] != "<"), None)

    def add(self, line):
        field = Field(len(self.fields) + 1, line)
        self.fields.append(field)
        self.by_name[field.name] = self.by_number[field.number] = field


def read_elements(text):
    elements = {}
    for line in text.strip().splitlines():
        if line.startswith("  "):
            element.add(line)  # pylint: disable=used-before-assignment
        else:
            element = Element(line)
            elements[element.name] = element
    return elements


ELEMENTS = read_elements(ELEMENTS_TEXT)
ROOT = ELEMENTS["asset"]


class Fault(Exception):
    """What is wrong with a file, and where."""


class Object:
    """An instance of an element: `values` by field name. References are ids once a file is read."""

    __slots__ = ("element", "values", "parent")

    def __init__(self, element, parent=None):
        self.element, self.parent = element, parent
        self.values = {}
        for field in element.fields:
            if field.kind == "many":
                self.values[field.name] = []
            elif field.kind == "optional":
                self.values[field.name] = None
            elif field.kind == "one":
                self.values[field.name] = self.child(field)
            else:
                self.values[field.name] = field.default()

    def child(self, field):
        """A new child for the field, not yet put anywhere, with what its place fixes."""
        made = Object(ELEMENTS[field.argument], self)
        if field.fixed:
            made.values[field.fixed[0]] = field.fixed[1]
        return made

    def __getitem__(self, name):
        return self.values[name]

    def __setitem__(self, name, value):
        self.values[name] = value

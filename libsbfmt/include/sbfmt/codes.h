/* Numbers of the diagnostics: stable, never reused. The page spec/codes.md explains each.
 *
 * Made from spec/sbf.codes by spec/generate/generate.py: change that, not this file. */
#ifndef SBFMT_CODES_H
#define SBFMT_CODES_H

#include "sbfmt/base.h"

#ifdef __cplusplus
extern "C" {
#endif

// clang-format off
/* Findings, by numbers that never change. */
typedef enum sbf_code {
  SBF_CODE_NONE = 0,
  SBF_CODE_IO_CANNOT_READ = 101, /* The file cannot be read: check the path and its permissions. */
  SBF_CODE_IO_CANNOT_WRITE = 102, /* The file cannot be written: check the folder, its permissions and the free space. */
  SBF_CODE_IO_UNKNOWN_FORMAT = 103, /* The content is none of the formats known: give a file of a listed format. */
  SBF_CODE_IO_TOO_LARGE = 104, /* The input is larger than the limit: raise the limit if the file is trusted. */
  SBF_CODE_OUT_OF_MEMORY = 105, /* Memory ran out, or the limit on it was reached. */
  SBF_CODE_BAD_CALL = 106, /* An argument of the call is wrong. */
  SBF_CODE_IO_CANNOT_RUN = 107, /* A helper program cannot be run: check that it is installed and may be executed. */
  SBF_CODE_CANCELLED = 108, /* The caller stopped the work. */
  SBF_CODE_NO_OPENGL = 120, /* There is nothing to draw pictures with: install Mesa's EGL and OpenGL. */
  SBF_CODE_OPENGL_FAILED = 121, /* OpenGL does not do what drawing needs of it: update the graphics driver. */
  SBF_CODE_NO_FFMPEG = 122, /* The program ffmpeg, which makes films, is not in PATH: install it. */
  SBF_CODE_FFMPEG_FAILED = 123, /* The program ffmpeg stopped with an error: it says why. */
  SBF_CODE_IMAGE_NOT_DRAWN = 124, /* A base colour image cannot be drawn, its material's colour stands for it: give it as a PNG that is whole. */
  SBF_CODE_NO_WINDOW = 125, /* There is no window to be had: install SDL 2, run it where there is a display, or draw pictures with `sbfmt render`. */
  SBF_CODE_XML_SYNTAX = 201, /* The text is not well-formed XML: mend it at the line given. */
  SBF_CODE_XML_DOCTYPE = 202, /* A DOCTYPE or an entity of its own stands in the file: remove it, the format has none. */
  SBF_CODE_XML_UNKNOWN_ELEMENT = 203, /* An element that the format does not have stands here: check its spelling and its place. */
  SBF_CODE_XML_UNKNOWN_ATTRIBUTE = 204, /* An attribute that the element does not have: check its spelling. */
  SBF_CODE_XML_BAD_VALUE = 205, /* A value is not of its type, as a word where a number belongs. */
  SBF_CODE_XML_REPEATED = 206, /* An element that may stand once stands twice. */
  SBF_CODE_XML_TOO_DEEP = 207, /* Elements lie inside each other deeper than the limit. */
  SBF_CODE_XML_STRAY_TEXT = 208, /* Text stands where only elements belong. */
  SBF_CODE_XML_NOT_SBF = 209, /* The document's root is not <sbf>: this is another kind of XML. */
  SBF_CODE_VERSION_TOO_NEW = 210, /* The file needs a newer version of the library: update, or save it with an older one. */
  SBF_CODE_VERSION_FIELD = 211, /* A field is of a later version than the file states: state that version. */
  SBF_CODE_VERSION_NEWER = 212, /* The file is of a newer minor version, and what this library does not know was left out: update it before you save the file anew. */
  SBF_CODE_REQUIRED_MISSING = 301, /* A field that must be given is missing. */
  SBF_CODE_VALUE_OUT_OF_RANGE = 302, /* A number lies outside its range. */
  SBF_CODE_VALUE_NOT_FINITE = 303, /* A number is infinite or not a number. */
  SBF_CODE_WRONG_LENGTH = 304, /* A list has not the length that goes with its neighbours. */
  SBF_CODE_INDEX_OUT_OF_RANGE = 305, /* An index names an item that is not there. */
  SBF_CODE_ENUM_OUT_OF_RANGE = 306, /* A value is none of the words of its enumeration. */
  SBF_CODE_LIST_TOO_LONG = 307, /* A list is longer than the limit: raise the limit if the file is trusted. */
  SBF_CODE_NOT_UTF8 = 308, /* A text is not valid UTF-8. */
  SBF_CODE_ID_EMPTY = 309, /* An id is empty. */
  SBF_CODE_ID_REPEATED = 310, /* Two objects have the same id: ids are unique in a file. */
  SBF_CODE_FIXED_VALUE = 311, /* A field has another value than its place demands. */
  SBF_CODE_BAD_TEXT = 312, /* A text holds a control character, which XML cannot carry: remove it. */
  SBF_CODE_REF_UNKNOWN = 401, /* A reference names an id that nothing of its kind has. */
  SBF_CODE_BONE_ORDER = 402, /* A bone stands before its parent, or among its own ancestors. */
  SBF_CODE_EXTENSION_REQUIRED = 403, /* The file requires an extension that this library does not know. */
  SBF_CODE_DERIVED_LOST = 404, /* Something refers to a derived part that is not made any more: let it name an authored one. */
  SBF_CODE_EXTENSION_REPEATED = 410, /* Two extensions have one name: a name is used once in a file. */
  SBF_CODE_EXTENSION_NAME = 411, /* An extension's name is not of the form VENDOR_what: two to eight capitals, an underscore, a word in small letters. */
  SBF_CODE_HASH_MALFORMED = 412, /* A SHA-256 is not 64 small hexadecimal digits: compute it anew or leave it out. */
  SBF_CODE_TEXTURE_MISSING = 420, /* An image file is not there: put it beside the bundle, or embed its bytes. */
  SBF_CODE_TEXTURE_PATH = 421, /* An image path is absolute, leaves the file's folder or has backslashes: write it relative to the file, with forward slashes. */
  SBF_CODE_TEXTURE_EMPTY = 422, /* A texture has neither a path nor bytes: give it one of them. */
  SBF_CODE_TEXTURE_TYPE = 423, /* Embedded bytes are not the image that their media type names: correct the type or embed the image again. */
  SBF_CODE_TETRAHEDRON_INVERTED = 501, /* A tetrahedron is inverted or flat, its volume is not positive: --fix turns it round, or takes it out where it is flat. */
  SBF_CODE_SURFACE_OPEN = 510, /* A surface that should enclose a volume is open: close it in the source. */
  SBF_CODE_SURFACE_NONMANIFOLD = 511, /* More than two polygons meet at an edge: remove what lies inside, or split it off. */
  SBF_CODE_SURFACE_WINDING = 512, /* Neighbouring polygons face opposite ways: turn some round, as --fix does. */
  SBF_CODE_SURFACE_STRAY_POLYGON = 513, /* A polygon stands on an edge that two others share already: remove it in the source. */
  SBF_CODE_SURFACE_INSIDE_OUT = 514, /* All polygons face inwards: turn them round, as --fix does. */
  SBF_CODE_SURFACE_PIECES = 515, /* A surface consists of several pieces: make a body of each where they should move apart. */
  SBF_CODE_SURFACE_EMPTY = 516, /* A body has nothing to simulate: give it polygons or a level. */
  SBF_CODE_POINT_UNUSED = 517, /* A point is in no polygon: remove it in the source, or by --fix. */
  SBF_CODE_POLYGON_FLAT = 518, /* A polygon has no area: remove it, or move its points apart. */
  SBF_CODE_POLYGON_REPEATED = 519, /* Two polygons have the same points: remove one. */
  SBF_CODE_TETRAHEDRON_SLIVER = 520, /* A tetrahedron is very flat, which makes it stiff in one direction and slows the simulation: mesh the volume again. */
  SBF_CODE_TETRAHEDRON_DUPLICATE = 521, /* Two tetrahedra have the same points: remove one, as --fix does. */
  SBF_CODE_LATTICE_PIECES = 522, /* The tetrahedra of a body do not hang together: join them, or make a body of each piece. */
  SBF_CODE_LATTICE_POINT_UNUSED = 523, /* Points of a lattice are in no tetrahedron: leave them out. */
  SBF_CODE_LEVEL_EMPTY = 524, /* A level has none of the elements its model asks for: add them, build again or choose another model. */
  SBF_CODE_LATTICE_NONMANIFOLD = 525, /* More than two tetrahedra share a face: remove those that overlap. */
  SBF_CODE_LATTICE_OVERLAP = 526, /* Two tetrahedra lie on the same side of the face they share: mesh the volume again. */
  SBF_CODE_COLORS_COUNT = 527, /* The numbers of elements by colour do not sum to the elements: clear color_counts, or colour again. */
  SBF_CODE_COLORS_SHARED = 528, /* Two elements of one colour share a point, which parallel solvers would move twice at once: clear color_counts, or colour again. */
  SBF_CODE_REGION_REPEATED = 529, /* A shape region names a point twice: name it once. */
  SBF_CODE_EMBEDDING_SUM = 530, /* Weights of an embedded vertex do not sum to one: divide them by their sum, as --fix does where the vertex then lies in its place, or build again. */
  SBF_CODE_EMBEDDING_OUTSIDE = 531, /* A vertex lies far outside the element that carries it: embed it in a nearer one. */
  SBF_CODE_EMBEDDING_BLEND = 532, /* Blends of a vertex that several bodies carry do not sum to one: divide them by their sum, as --fix does. */
  SBF_CODE_EMBEDDING_MISSING = 533, /* Vertices of a carried mesh are carried by nothing: build again, or give the mesh a skin. */
  SBF_CODE_EMBEDDING_LENGTH = 534, /* An embedding names another number of vertices than it embeds: make the lists equally long. */
  SBF_CODE_EMBEDDING_VERTEX = 535, /* An embedding names a vertex that its mesh does not have: build again. */
  SBF_CODE_SKIN_SUM = 536, /* Skin weights of a point do not sum to one: normalise them, as --fix does. */
  SBF_CODE_SPRING_SAME_POINT = 540, /* A spring joins a point to itself: remove it, as --fix does. */
  SBF_CODE_SPRING_NO_LENGTH = 541, /* A spring has no rest length and so no direction to act in: state one, or remove the spring. */
  SBF_CODE_SPRING_DUPLICATE = 542, /* Two springs join the same two points: keep one, as --fix does where they agree. */
  SBF_CODE_SPRING_INERT = 543, /* A spring joins two held points and does nothing: remove it, as --fix does. */
  SBF_CODE_SPRING_STRAINED = 544, /* A spring is far from its rest length at rest and jerks at the start: state a rest length that fits the points. */
  SBF_CODE_SPRING_LIMP = 545, /* Springs have no stiffness and do nothing: state a stiffness, or leave it out to have it from the material. */
  SBF_CODE_SPRING_IDLE = 546, /* Springs beside another model act only where they are marked extra: mark or remove them. */
  SBF_CODE_POINT_LOOSE = 547, /* Free points hang on nothing and fall away: give them springs, elements or a pin. */
  SBF_CODE_LEVEL_PIECES = 548, /* Parts of a level hang on nothing that is held: join or pin them. */
  SBF_CODE_CROSS_SPRING_LEVEL = 549, /* Cross springs name a level that the body does not have: name one of its levels, from 0. */
  SBF_CODE_CROSS_SPRING_POINT = 550, /* A cross spring names a point that its level does not have: name points of the levels stated. */
  SBF_CODE_HULL_FLAT = 551, /* A section has too little depth for a convex hull: it gets none. */
  SBF_CODE_EMBEDDING_FLAT = 552, /* Vertices lie off a body without depth beside them, and are carried at its surface instead. */
  SBF_CODE_EMBEDDING_NO_BODY = 553, /* No soft body carries a mesh: it moves with its bones alone. */
  SBF_CODE_ATTACHMENT_NO_HULL = 554, /* An attachment names a rigid body without a hull: nothing lies inside it. */
  SBF_CODE_BODY_WITHOUT_POINTS = 555, /* A soft body has no points: nothing can be built for it. */
  SBF_CODE_CROSS_SPRING_ONE_BODY = 556, /* Cross springs join a body to itself: make them a spring set of its level. */
  SBF_CODE_SURFACE_CROSSES = 560, /* A surface passes through itself: pull the crossing polygons apart in the source. */
  SBF_CODE_SURFACE_UNWELDED = 561, /* Points at an open seam stand in one place and are not joined, so the body comes apart there: weld them in the source. */
  SBF_CODE_INTERIOR_OUTSIDE = 562, /* An interior point lies outside the surface: move it inside or remove it. */
  SBF_CODE_POLYGON_SIDE_EMPTY = 563, /* A polygon names a point twice in a row: remove one of the corners. */
  SBF_CODE_REGION_FLAT = 564, /* A shape region is a point, a line or a plane and can turn over: add points off it. */
  SBF_CODE_REGION_POINT_LEFT_OUT = 565, /* Free points are in no shape region, nothing holds them: add them to one. */
  SBF_CODE_LEVEL_POINT_MOVED = 566, /* Points of a level are not where their source points are: build again. */
  SBF_CODE_LEVEL_MAP = 567, /* Two source points are one point of a level: build again. */
  SBF_CODE_LEVEL_ORDER = 568, /* A level is finer than the one before it: list the finest first. */
  SBF_CODE_EMBEDDING_OFF = 570, /* Embedded vertices are not where the mesh has them at rest and jump at the start: build again. */
  SBF_CODE_EMBEDDING_REPEATED = 571, /* An embedding carries a vertex twice: keep one. */
  SBF_CODE_SKIN_BONE_REPEATED = 572, /* A point names one bone twice: add the two weights up. */
  SBF_CODE_NORMALS_LENGTH = 573, /* There is not one normal a point: give one each, or name them by normal_corners. */
  SBF_CODE_NORMAL_NOT_UNIT = 574, /* A normal is not of unit length: normalise it, as --fix does. */
  SBF_CODE_UV_LENGTH = 575, /* There is not one texture coordinate a point: give one each, or name them by corners. */
  SBF_CODE_SHAPE_KEY_REPEATED = 576, /* A shape key names a point twice: add the two offsets up. */
  SBF_CODE_RENDER_LEVEL_ORDER = 577, /* A render level has no fewer triangles than the one before it: list the finest first. */
  SBF_CODE_MESH_EMPTY = 578, /* A render mesh has no polygons, nothing is seen of it: give it some or remove it. */
  SBF_CODE_MATERIAL_NO_UVS = 579, /* A mesh with an image on it has no texture coordinates: unwrap it, or take the image off the material. */
  SBF_CODE_WEIGHT_MAP_ZERO = 580, /* A weight map takes all mass or stiffness from a free point: give it a factor above 0. */
  SBF_CODE_WEIGHT_MAP_IDLE = 581, /* A weight map scales an attribute that is 0: set the attribute or remove the map. */
  SBF_CODE_RENDER_LEVEL_CORNER = 582, /* A corner of a render level takes its looks from a corner of the full mesh at another point: name one at the same. */
  SBF_CODE_RENDER_LEVEL_ERROR = 583, /* A render level is farther from the full mesh than it states: state the true distance, or build it again. */
  SBF_CODE_MESH_POINT_UNUSED = 586, /* Points of a render mesh are in no polygon and only cost memory: remove them in the source, or by --fix. */
  SBF_CODE_COLORS_LENGTH = 588, /* There is not one colour a point: give one each, or name them by color_corners. */
  SBF_CODE_LATTICE_THIN = 590, /* Parts of a body are thinner than two elements of its lattice, which is thicker there than the body: give a smaller cell, or more elements. */
  SBF_CODE_LATTICE_EMPTY = 591, /* A body encloses nothing that a lattice of that cell could fill: it gets springs over its surface. */
  SBF_CODE_LATTICE_TOO_FINE = 592, /* The cell is too small for a body of that size, or for all bodies together: give a larger one, or fewer elements. */
  SBF_CODE_EMBEDDING_FAR = 593, /* Vertices lie farther than a cell outside the lattice that carries them: give a smaller cell, or take those in no polygon out of the source. */
  SBF_CODE_INTERIOR_TOO_MANY = 594, /* A body has too many points for springs between all of them: give another method. */
  SBF_CODE_LEVEL_OFF = 597, /* A lattice gives by more than a quarter more or less than its matter under some load: give it more elements. */
  SBF_CODE_LEVEL_ERROR_MISSED = 598, /* No lattice coarser than the reference comes within the error asked for: the body got one as fine as that. */
  SBF_CODE_LEVEL_UNSETTLED = 599, /* A level comes to no rest under gravity, as parts of it turn about what holds them: give it more elements, or pin more points. */
  SBF_CODE_BODY_NO_MASS = 601, /* A body that moves has no mass: give it a density, an area density or a mass. */
  SBF_CODE_POISSON_UNSHOWN = 602, /* A spring level cannot show the Poisson ratio that the material asks for: take 0.25, or tetrahedra. */
  SBF_CODE_SUBSTEPS_TOO_FEW = 603, /* An explicit scheme with so few substeps gains energy and bursts: use at least the number named. */
  SBF_CODE_UNIT_LOOKS_WRONG = 604, /* The asset is as large as a house or as small as a grain, its unit looks wrong: convert the source with --unit. */
  SBF_CODE_DERIVED_STALE = 605, /* Derived parts were made from another source: run sbfmt build again, or --fix. */
  SBF_CODE_DENSITY_LOOKS_WRONG = 606, /* A density is like that of no matter: state it in kg/m^3, water has 1000. */
  SBF_CODE_BODY_COLLAPSES = 607, /* A body cannot bear its own weight: raise young_modulus, which is in Pa, or lower the density. */
  SBF_CODE_POINT_NO_MASS = 608, /* A free point has no mass and would be thrown out of all bounds: give it some or pin it. */
  SBF_CODE_STRAIN_ORDER = 609, /* A strain bound keeps springs from ever yielding or tearing: order them as yield, tear, strain_max. */
  SBF_CODE_GRAVITY_LOOKS_WRONG = 610, /* Gravity is like that of no planet: state it in m/s^2, with +Y up. */
  SBF_CODE_FIELD_NO_DIRECTION = 611, /* A uniform field or a vortex has no direction and does nothing: give it one. */
  SBF_CODE_FOLLOWER_TOO_FAST = 612, /* A follower swings faster than the control tick can show: lower its frequency. */
  SBF_CODE_FOLLOWER_UNDAMPED = 613, /* A follower without damping swings for ever: give it a damping ratio. */
  SBF_CODE_COLLISION_SELF_MASKED = 614, /* A body is to meet itself and its own mask leaves its layer out: add the layer to the mask. */
  SBF_CODE_COLLISION_ONE_SIDED = 615, /* One of two things is to meet the other and not the reverse, so they never meet: let each mask have the other's layer. */
  SBF_CODE_PARTICLE_TOO_LARGE = 616, /* A particle radius is larger than the body: state it in metres. */
  SBF_CODE_PRESSURE_OPEN = 617, /* Pressure acts on closed surfaces only: close the surface or set the mode to none. */
  SBF_CODE_LEVEL_NOT_SIMULATED = 641, /* The runtime does not step this elastic model: build the file with springs or tetrahedra. */
  SBF_CODE_TOO_STIFF = 642, /* A body is too stiff and light to be stepped explicitly: give it more mass, less stiffness or fewer points. */
  SBF_CODE_PART_LEFT_OUT = 643, /* The file holds something that this runtime does not move: another runtime, or a later one, does. */
  SBF_CODE_SCHEME_BIASED = 644, /* A body is stepped by a scheme that is known to be off its energy by more than a tenth: leave the choice open, or give more substeps. */
  SBF_CODE_RIG_SECTION_GUESSED = 701, /* A section was given to the nearest bone, because no name said where it belongs. */
  SBF_CODE_RIG_UNWEIGHTED_POINTS = 702, /* Points of a skinned mesh have no weights: paint them in the source. */
  SBF_CODE_RIG_NO_SECTIONS = 703, /* Every mesh is skinned: no bone has a section of its own until a build cuts some. */
  SBF_CODE_RIG_NO_LEGS = 704, /* No chain of bones ends at the ground: no gait is proposed. */
  SBF_CODE_RIG_BONE_REHUNG = 705, /* A bone that was moved by hand and holds skin now hangs on the limb that ends at it. */
  SBF_CODE_SECTION_MERGED = 706, /* What a bone holds is too little for a section: it goes to another bone's. */
  SBF_CODE_SECTION_OPEN = 707, /* A section cut from a skin could not be closed: remove in the source what joins more than two polygons at an edge. */
  SBF_CODE_SECTION_STRETCHED = 708, /* Triangles of a skin stretch far where a joint bends: smooth the weights there in the source. */
  SBF_CODE_RIG_CRAWLS = 709, /* No limb of the rig comes down to the ground: its body is proposed as a chain that follows its first bone. */
  SBF_CODE_SECTION_NO_BONE = 710, /* A body of a file with a skeleton hangs on nothing: name its bone or pin it. */
  SBF_CODE_SECTION_UNHELD = 711, /* A section has a bone and no pins: pin it, or build again. */
  SBF_CODE_NAME_REPEATED = 712, /* Two objects of one kind have one name: rename one of them. */
  SBF_CODE_ROTATION_NOT_UNIT = 713, /* A rotation is not of unit length: normalise it, as --fix does. */
  SBF_CODE_HULL_NOT_CONVEX = 714, /* A hull is not convex: run sbfmt build, which makes one that is. */
  SBF_CODE_JOINT_FRAME = 715, /* A joint's frame is not orthonormal: normalise its rotation, as --fix does. */
  SBF_CODE_JOINT_ONE_BODY = 716, /* A joint joins a body to itself: name two bodies. */
  SBF_CODE_LIMIT_ORDER = 717, /* A limit has its minimum above its maximum: swap them. */
  SBF_CODE_IK_CHAIN_BROKEN = 718, /* The end of a chain does not hang below its root: choose a root above the end. */
  SBF_CODE_RIG_LIMITS_PROPOSED = 719, /* Joint limits are proposed by the names and places of bones: confirm or change them. */
  SBF_CODE_PIN_SET_EMPTY = 720, /* A pin set holds nothing: name points or remove it. */
  SBF_CODE_PIN_REPEATED = 721, /* A point is held twice, of which the first counts: keep one, as --fix does. */
  SBF_CODE_PIN_RANGE = 722, /* A pin set's minimum is above its maximum: swap them. */
  SBF_CODE_PIN_TWO_FRAMES = 723, /* A pin set names two frames and can follow one: keep the bone or the rigid body. */
  SBF_CODE_SECTION_FAR = 725, /* A section lies far from its bone: check which bone it names. */
  SBF_CODE_IK_BONE_COUNT = 726, /* A two_bone chain does not run over one bone between root and end: choose another root, end or solver. */
  SBF_CODE_IK_NO_BEND = 727, /* A straight chain has no pole to bend towards: give it one that is off the line from root to end. */
  SBF_CODE_IK_COMFORT_OUTSIDE = 728, /* A comfort names a bone outside its chain: name one from root to end. */
  SBF_CODE_IK_NO_REACH = 729, /* A chain has no length: place the heads of its bones apart. */
  SBF_CODE_LEG_HOME_BEYOND_REACH = 730, /* A leg does not reach its home: place the home nearer or make the leg longer. */
  SBF_CODE_LEG_TRIGGER_BEYOND_REACH = 731, /* A leg cannot go as far from home as step_trigger asks before it steps: lower step_trigger. */
  SBF_CODE_LEG_REPEATED = 732, /* Two legs share an IK chain: give each its own. */
  SBF_CODE_GAIT_ONE_GROUP = 733, /* All legs are in one group and may leave the ground at once: spread them over two groups. */
  SBF_CODE_GAIT_NO_LEGS = 734, /* A gait has no legs: add some or remove it. */
  SBF_CODE_GAIT_BONE_OUTSIDE = 735, /* A bone of a gait does not hang on the gait's body: choose a body above it. */
  SBF_CODE_GAIT_STEP_TOO_SHORT = 736, /* A step is shorter than two control ticks: lengthen step_duration or shorten the tick. */
  SBF_CODE_GAIT_STEP_TOO_HIGH = 737, /* A step is higher than the leg is long: lower step_height. */
  SBF_CODE_LEG_UNEVEN = 738, /* The soles of the legs are not level at rest: check home and sole. */
  SBF_CODE_CHAIN_EMPTY = 740, /* A chain has fewer than two bones and nothing to move: name more or remove it. */
  SBF_CODE_CHAIN_BROKEN = 741, /* Bones of a chain do not hang on one another in order: list them from the leading bone on. */
  SBF_CODE_BONE_REPEATED = 742, /* A list of bones names one twice: name it once. */
  SBF_CODE_FOLLOWER_REPEATED = 743, /* Two followers move one property of a bone: keep one. */
  SBF_CODE_CLIP_TIMES = 744, /* Times of keys do not increase, or begin below 0: sort the keys. */
  SBF_CODE_CLIP_VALUES = 745, /* A track has another number of values than its keys need: see the element track of the reference. */
  SBF_CODE_CLIP_EMPTY = 746, /* A clip has nothing to play: give it tracks with keys or remove it. */
  SBF_CODE_CLIP_PAST_END = 747, /* Keys lie behind the end of their clip and are never played: lengthen it or remove them. */
  SBF_CODE_CLIP_TRACK_REPEATED = 748, /* Two tracks of a clip key one property of a bone: keep one. */
  SBF_CODE_CLIP_SCALE = 749, /* A key scales a bone to nothing or turns it inside out: keep scales above 0. */
  SBF_CODE_POSE_REPEATED = 750, /* A pose sets a bone twice: keep one. */
  SBF_CODE_POSE_DISTANCE = 751, /* Two poses of a walk stand at one distance, or one is negative: give each its own place in the cycle. */
  SBF_CODE_POSE_EMPTY = 752, /* A pose sets no bone: add keys or remove it. */
  SBF_CODE_HULL_OPEN = 753, /* A hull is not closed: run sbfmt build, which makes one that is. */
  SBF_CODE_INERTIA_IMPOSSIBLE = 754, /* No body has such principal moments: each must be no more than the other two together. */
  SBF_CODE_CENTER_OUTSIDE = 755, /* A rigid body's centre lies outside its hull: check its place, or leave the inertia out. */
  SBF_CODE_JOINT_NOT_AT_REST = 756, /* A joint does not fit the rest pose and jerks at the start: place both frames where the bodies meet. */
  SBF_CODE_LIMIT_IDLE = 757, /* A limit bounds a motion that the joint does not have: remove it or choose another kind. */
  SBF_CODE_LIMIT_REPEATED = 758, /* Two limits bound one motion: keep the narrower. */
  SBF_CODE_LIMIT_BEYOND_RANGE = 759, /* A limit lies beyond what its motion can reach: state angles in radians, distances above 0. */
  SBF_CODE_LIMIT_EXCLUDES_REST = 760, /* The rest pose lies outside a limit and jerks at the start: widen the limit or move the frames. */
  SBF_CODE_DRIVE_IDLE = 761, /* A drive moves what the joint holds, or has neither stiffness nor damping: remove it or let it act. */
  SBF_CODE_PULLEY_NO_ROPE = 762, /* A pulley joint has no rope: place pulley_a and pulley_b away from the bodies' frames. */
  SBF_CODE_PIN_NO_WEIGHT = 763, /* All weights of a pin set are 0, it holds nothing: raise weights or minimum. */
  SBF_CODE_PIN_OFFSET = 764, /* Pins draw points far from where they are at rest: check the offsets, which are in the frame of the bone or body. */
  SBF_CODE_ATTACHMENT_EMPTY = 765, /* An attachment holds no point: place the hull around some, or list them. */
  SBF_CODE_RIG_ALIGNED = 781, /* The input was scaled, turned or moved to lie over the rig: state its unit and axes if that is wrong. */
  SBF_CODE_RIG_WEIGHTS = 782, /* Points of the input were given to bones of the rig: by name, by place, by nearness, from the bones or from a file. */
  SBF_CODE_RIG_MISFIT = 783, /* The rig does not fit the input: give the character's own rig, its unit and axes, or other weights. */
  SBF_CODE_RIG_WEIGHTS_FILE = 784, /* A file of weights names a bone, a point or a number that cannot be: mend the line given. */
  SBF_CODE_RIG_WEIGHTS_LOST = 785, /* Weights of points sum to much less than one, as where they name joints that the file does not have: export the skin again. */
  SBF_CODE_RIG_OBJECT_APART = 786, /* No bone lies in or beside an object whose weights were computed: convert another character with a rig of its own. */
  SBF_CODE_PACKED_MAGIC = 801, /* The file does not begin as a packed file does: it was damaged in transfer, or is another kind. */
  SBF_CODE_PACKED_TRUNCATED = 802, /* The file ends before what its table names: it was cut short. */
  SBF_CODE_PACKED_TABLE = 803, /* The header or the table of contents contradicts itself. */
  SBF_CODE_PACKED_CRC = 804, /* A chunk's bytes do not match their CRC-32: the file is damaged. */
  SBF_CODE_PACKED_INFLATE = 805, /* A chunk does not inflate to the size its entry names. */
  SBF_CODE_PACKED_RATIO = 806, /* A chunk inflates to more than the limit allows. */
  SBF_CODE_PACKED_RECORD = 807, /* A record does not hold together. */
  SBF_CODE_PACKED_CODEC = 808, /* A chunk uses a codec or a filter that this library does not know. */
  SBF_CODE_PACKED_UNKNOWN_PART = 809, /* A critical part of an unknown kind: the file needs a newer reader. */
  SBF_CODE_IMPORT_SYNTAX = 901, /* A line of a text file of another program is not what its form demands: mend or export it again. */
  SBF_CODE_IMPORT_INDEX = 902, /* A polygon refers to a vertex, normal or texture coordinate that the file does not have. */
  SBF_CODE_IMPORT_NOT_FINITE = 903, /* A number of the imported file is infinite or not a number: export it again. */
  SBF_CODE_IMPORT_POLYGON = 904, /* A polygon has fewer than three corners, or more than 65,535: divide it. */
  SBF_CODE_IMPORT_EMPTY = 905, /* The imported file holds neither a surface nor bones. */
  SBF_CODE_IMPORT_REFUSED = 906, /* The importer of this form refuses the file: export it as a current FBX, glTF 2.0 or OBJ. */
  SBF_CODE_IMPORT_CRASHED = 907, /* The importer broke down on the file, which is damaged or unusual: export it again or in another form. */
  SBF_CODE_IMPORT_LIMIT = 908, /* The importer needed more time, memory or output than it may have: raise the limit if the file is trusted. */
  SBF_CODE_IMPORT_HELPER_MISSING = 909, /* The program sbfmt-import cannot be found or run: install it beside sbfmt or set SBFMT_IMPORT_HELPER. */
  SBF_CODE_IMPORT_STREAM = 910, /* What sbfmt-import sent cannot be read: it is of another version, or was cut off. */
  SBF_CODE_IMPORT_MATERIALS_MISSING = 931, /* A material library or a material of the file is missing: grey is used. */
  SBF_CODE_IMPORT_IGNORED = 932, /* The file holds things that are passed over. */
  SBF_CODE_IMPORT_POINTS_LEFT_OUT = 933, /* Vertices that no polygon uses belong to no object and are left out. */
  SBF_CODE_IMPORT_MESH_INVENTED = 934, /* The importer made up a mesh for a file that has none: it is left out. */
  SBF_CODE_IMPORT_NAME_AMBIGUOUS = 935, /* Several nodes have the name by which a skin or a clip refers to one of them. */
  SBF_CODE_IMPORT_AXES = 936, /* The file states axes that make no frame: +Y up is assumed. */
  SBF_CODE_IMPORT_KEYS = 937, /* Keys of an animation are left out: they do not hold together. */
  SBF_CODE_IMPORT_IMAGE = 938, /* An image cannot be taken over. */
  SBF_CODE_IMPORT_UNIT = 939, /* The file states no unit of use: metres are assumed. */
  SBF_CODE_IMPORT_POSE = 940, /* The file was saved in the middle of a movement: bones and skin are taken as they were bound. */
  SBF_CODE_IMPORT_POINTS_JOINED = 941, /* Vertices stored apart for drawing stand in one place and move alike: they are one point. */
  SBF_CODE_IMPORT_MOTION = 942, /* A clip of a motion file was carried over: which bones it moves, how far it goes. */
  SBF_CODE_IMPORT_MOTION_UNMATCHED = 943, /* Bones found no counterpart in the other skeleton: here they go along with their parents, there their motion is lost. */
  SBF_CODE_IMPORT_MOTION_NONE = 944, /* A motion file has no clip, or no bone of it stands for one of the skeleton: name bones alike, or add retarget chains. */
  SBF_CODE_IMPORT_NO_MESH = 950, /* The file holds a skeleton and no mesh. */
  SBF_CODE_IMPORT_NO_RIG = 951, /* The file holds no skeleton: bodies are not held by bones. */
  SBF_CODE_IMPORT_NO_BONES = 952, /* The file given as the rig holds no skeleton. */
  SBF_CODE_IMPORT_PARTIAL_UVS = 953, /* A set of texture coordinates does not cover the whole mesh and was dropped. */
  SBF_CODE_IMPORT_INSIDE_OUT = 954, /* All polygons of a closed surface faced inwards: they were turned round. */
  SBF_CODE_IMPORT_GROUND = 955, /* The character did not stand on y = 0 and was moved there. */
  SBF_CODE_IMPORT_PIN_UNKNOWN = 956, /* A pin or an attachment names a group, an object or a bone that the input does not have: see what sbfmt info lists. */
  SBF_CODE_MATERIAL_GUESSED = 957, /* Nobody says what bodies are made of: sections on bones are taken for flesh, and what the usual modulus would not bear is as stiff as it takes to stand. */
  SBF_CODE_IMPORT_FACING = 958, /* The character did not look along +Z and was turned to. */
  SBF_CODE_IMPORT_TETRAHEDRA_TURNED = 960, /* Tetrahedra were listed the other way round: they have been turned. */
  SBF_CODE_IMPORT_TETRAHEDRA_FLAT = 961, /* Tetrahedra without volume were left out. */
  SBF_CODE_IMPORT_WEIGHTS_IMPOSSIBLE = 970, /* Skin weights cannot be computed: give a mesh with a surface, and a rig with bones that move it. */
  SBF_CODE_IMPORT_RIG_OUTSIDE = 971, /* Less than 60 % of the rig's bone length lies inside the mesh: give the rig of this mesh, or state --unit, --up and --forward. */
  SBF_CODE_IMPORT_WEIGHTS_COMPUTED = 972, /* The rig has no mesh to take weights from: they were computed. */
  SBF_CODE_EXPORT_EMPTY = 980, /* The asset has nothing that the form to be written could hold. */
  SBF_CODE_EXPORT_LEFT_OUT = 981, /* The form to be written has no place for parts of the asset: they are left out. */
  SBF_CODE_EXPORT_PAGE_MISSING = 982, /* What a page is made of cannot be found: build sbfmt where clang makes WebAssembly or set SBFMT_WEB. */
} sbf_code;
// clang-format on

/* What a code stands for. */
typedef struct sbf_code_info {
  const char *name;      /* as in reports */
  sbf_code code;         /* its number */
  sbf_severity severity; /* how much it weighs */
  sbf_status fault;      /* SBF_BAD_INPUT or SBF_FAILED */
  const char *text;      /* what it says and what to do */
} sbf_code_info;

/* What a code stands for; NULL for a number that is none. */
SBF_API const sbf_code_info *sbf_code_find(int32_t code);

/* All of them, by number. */
SBF_API const sbf_code_info *sbf_code_table(uint32_t *count);

#ifdef __cplusplus
}
#endif
#endif

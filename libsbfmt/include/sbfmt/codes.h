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
/* Codes of findings. Their numbers never change. */
typedef enum sbf_code {
  SBF_CODE_NONE = 0,
  SBF_CODE_IO_CANNOT_READ = 101, /* The file cannot be read: check the path and its permissions. */
  SBF_CODE_IO_CANNOT_WRITE = 102, /* The file cannot be written: check the folder, its permissions and the free space. */
  SBF_CODE_IO_UNKNOWN_FORMAT = 103, /* The content has no known format: use a file of a listed format. */
  SBF_CODE_IO_TOO_LARGE = 104, /* The input is larger than the limit: raise the limit if the file is trusted. */
  SBF_CODE_OUT_OF_MEMORY = 105, /* Memory ran out, or its limit was reached: free memory, or raise the limit. */
  SBF_CODE_BAD_CALL = 106, /* An argument of the call is wrong: correct the one that the message names. */
  SBF_CODE_IO_CANNOT_RUN = 107, /* A helper program cannot be run: check that it is installed and may be executed. */
  SBF_CODE_CANCELLED = 108, /* The caller cancelled the work: call again to repeat it. */
  SBF_CODE_WORLD_INVALID = 109, /* The state of a world violates an invariant: report it as a bug of the runtime, with the scene. */
  SBF_CODE_NO_OPENGL = 120, /* Pictures cannot be drawn without EGL and OpenGL: install Mesa. */
  SBF_CODE_OPENGL_FAILED = 121, /* OpenGL lacks a feature that drawing needs: update the graphics driver. */
  SBF_CODE_NO_FFMPEG = 122, /* The program ffmpeg, which makes films, is not in PATH: install it. */
  SBF_CODE_FFMPEG_FAILED = 123, /* The program ffmpeg stopped with an error: see its message. */
  SBF_CODE_IMAGE_NOT_DRAWN = 124, /* A base color image cannot be drawn, so its material's color is used: replace it by an intact PNG, JPEG or WebP. */
  SBF_CODE_NO_WINDOW = 125, /* No window can be opened: install SDL 2, run it with a display, or draw pictures with `sbfmt render`. */
  SBF_CODE_XML_SYNTAX = 201, /* The text is not well-formed XML: correct it at the line given. */
  SBF_CODE_XML_DOCTYPE = 202, /* The file has a DOCTYPE or defines an entity: remove it. */
  SBF_CODE_XML_UNKNOWN_ELEMENT = 203, /* The format has no such element here: check its spelling and its parent. */
  SBF_CODE_XML_UNKNOWN_ATTRIBUTE = 204, /* The element has no such attribute: check its spelling. */
  SBF_CODE_XML_BAD_VALUE = 205, /* A value has the wrong type, for example a word instead of a number: correct it. */
  SBF_CODE_XML_REPEATED = 206, /* An element occurs twice where one is allowed: remove one. */
  SBF_CODE_XML_TOO_DEEP = 207, /* Elements are nested deeper than the limit: raise the limit if the file is trusted. */
  SBF_CODE_XML_STRAY_TEXT = 208, /* Text occurs where only elements are allowed: remove it. */
  SBF_CODE_XML_NOT_SBF = 209, /* The document's root is not <sbf>: use a file of this format, or convert it with sbfmt convert. */
  SBF_CODE_VERSION_TOO_NEW = 210, /* The file needs a newer version of the library: update, or save it with an older one. */
  SBF_CODE_VERSION_FIELD = 211, /* A field needs a later version than the file states: state that version. */
  SBF_CODE_VERSION_NEWER = 212, /* The file has a newer minor version, and unknown content was skipped: update the library before you save the file. */
  SBF_CODE_REQUIRED_MISSING = 301, /* A required field is missing: add it. */
  SBF_CODE_VALUE_OUT_OF_RANGE = 302, /* A number is outside its range: use one inside. */
  SBF_CODE_VALUE_NOT_FINITE = 303, /* A number is infinite or not a number: replace it. */
  SBF_CODE_WRONG_LENGTH = 304, /* The length of a list does not match its related lists: make them equal. */
  SBF_CODE_INDEX_OUT_OF_RANGE = 305, /* An index names an item that does not exist: use one below the number of items. */
  SBF_CODE_ENUM_OUT_OF_RANGE = 306, /* A value is not in its enumeration: use one of the listed words. */
  SBF_CODE_LIST_TOO_LONG = 307, /* A list is longer than the limit: raise the limit if the file is trusted. */
  SBF_CODE_NOT_UTF8 = 308, /* A text is not valid UTF-8: save it as UTF-8. */
  SBF_CODE_ID_EMPTY = 309, /* An id is empty: choose one that is unique in the file. */
  SBF_CODE_ID_REPEATED = 310, /* Two objects have the same id: make ids unique in the file. */
  SBF_CODE_FIXED_VALUE = 311, /* A field has another value than its position requires: use the required one. */
  SBF_CODE_BAD_TEXT = 312, /* A text has a control character, which XML does not allow: remove it. */
  SBF_CODE_REF_UNKNOWN = 401, /* A reference names an id that no object of its kind has: correct the id. */
  SBF_CODE_BONE_ORDER = 402, /* A bone precedes its parent, or is its own ancestor: list parents first. */
  SBF_CODE_EXTENSION_REQUIRED = 403, /* The file requires an extension that this library does not know: use a program that supports it. */
  SBF_CODE_DERIVED_LOST = 404, /* A reference names a derived part that the build no longer makes: name an authored part. */
  SBF_CODE_EXTENSION_REPEATED = 410, /* Two extensions have the same name: keep one. */
  SBF_CODE_EXTENSION_NAME = 411, /* An extension's name does not have the form VENDOR_what: use two to eight capitals, an underscore and a lower-case word. */
  SBF_CODE_HASH_MALFORMED = 412, /* A SHA-256 is not 64 lower-case hexadecimal digits: compute it again or remove it. */
  SBF_CODE_TEXTURE_MISSING = 420, /* An image file is missing: put it beside the file, or embed its bytes. */
  SBF_CODE_TEXTURE_PATH = 421, /* An image path is absolute, leaves the file's folder or has backslashes: write it relative to the file, with forward slashes. */
  SBF_CODE_TEXTURE_EMPTY = 422, /* A texture has neither a path nor bytes: add one of them. */
  SBF_CODE_TEXTURE_TYPE = 423, /* Embedded bytes are not the image that their media type names: correct the type or embed the image again. */
  SBF_CODE_TETRAHEDRON_INVERTED = 501, /* A tetrahedron is inverted or flat, so its volume is not positive: swap two of its points or remove it, as --fix does. */
  SBF_CODE_SURFACE_OPEN = 510, /* A surface that should enclose a volume is open: close it in the source. */
  SBF_CODE_SURFACE_NONMANIFOLD = 511, /* More than two polygons share an edge: remove inner polygons, or split them off. */
  SBF_CODE_SURFACE_WINDING = 512, /* Neighboring polygons face opposite directions: reverse some, as --fix does. */
  SBF_CODE_SURFACE_STRAY_POLYGON = 513, /* A polygon is on an edge that two others share: remove it in the source. */
  SBF_CODE_SURFACE_INSIDE_OUT = 514, /* All polygons face inwards: reverse them, as --fix does. */
  SBF_CODE_SURFACE_PIECES = 515, /* A surface consists of several pieces: make a body of each if they should move separately. */
  SBF_CODE_SURFACE_EMPTY = 516, /* A body has nothing to simulate: add polygons or a level. */
  SBF_CODE_POINT_UNUSED = 517, /* A point is in no polygon: remove it in the source, or by --fix. */
  SBF_CODE_POLYGON_FLAT = 518, /* A polygon has no area: remove it, or move its points apart. */
  SBF_CODE_POLYGON_REPEATED = 519, /* Two polygons have the same points: remove one. */
  SBF_CODE_TETRAHEDRON_SLIVER = 520, /* A tetrahedron is very flat, which makes it stiff in one direction and slows the simulation: mesh the volume again. */
  SBF_CODE_TETRAHEDRON_DUPLICATE = 521, /* Two tetrahedra have the same points: remove one, as --fix does. */
  SBF_CODE_LATTICE_PIECES = 522, /* The tetrahedra of a body are not connected: join them, or make a body of each piece. */
  SBF_CODE_LATTICE_POINT_UNUSED = 523, /* Points of a lattice are in no tetrahedron: remove them. */
  SBF_CODE_LEVEL_EMPTY = 524, /* A level has no element of its model: add them, build again or choose another model. */
  SBF_CODE_LATTICE_NONMANIFOLD = 525, /* More than two tetrahedra share a face: remove those that overlap. */
  SBF_CODE_LATTICE_OVERLAP = 526, /* Two tetrahedra are on the same side of the face that they share: mesh the volume again. */
  SBF_CODE_COLORS_COUNT = 527, /* The numbers of elements by color do not sum to the number of elements: clear color_counts, or color again. */
  SBF_CODE_COLORS_SHARED = 528, /* Two elements of one color share a point, so parallel solvers would conflict: clear color_counts, or color again. */
  SBF_CODE_REGION_REPEATED = 529, /* A shape region names a point twice: name it once. */
  SBF_CODE_EMBEDDING_SUM = 530, /* Weights of an embedded vertex do not sum to one: divide them by their sum, as --fix does if the vertex then has its position, or build again. */
  SBF_CODE_EMBEDDING_OUTSIDE = 531, /* A weight of an embedded vertex is below -0.5 or above 1.5, so the vertex jumps at small strains: build again, or embed it in a nearer element. */
  SBF_CODE_EMBEDDING_BLEND = 532, /* Blend weights of a vertex embedded in several bodies do not sum to one: divide them by their sum, as --fix does. */
  SBF_CODE_EMBEDDING_MISSING = 533, /* Vertices of an embedded mesh are not embedded: build again, or add skin weights to the mesh. */
  SBF_CODE_EMBEDDING_LENGTH = 534, /* The lists of an embedding have different lengths: make them equal. */
  SBF_CODE_EMBEDDING_VERTEX = 535, /* An embedding names a vertex that its mesh does not have: build again. */
  SBF_CODE_SKIN_SUM = 536, /* Skin weights of a point do not sum to one: normalize them, as --fix does. */
  SBF_CODE_SPRING_SAME_POINT = 540, /* A spring joins a point to itself: remove it, as --fix does. */
  SBF_CODE_SPRING_NO_LENGTH = 541, /* A spring has no rest length and so no direction: state a length, or remove the spring. */
  SBF_CODE_SPRING_DUPLICATE = 542, /* Two springs join the same two points: keep one, as --fix does if they agree. */
  SBF_CODE_SPRING_INERT = 543, /* A spring joins two pinned points and has no effect: remove it, as --fix does. */
  SBF_CODE_SPRING_STRAINED = 544, /* A spring is far from its rest length in the rest pose and jerks at the start: state a rest length that fits the points. */
  SBF_CODE_SPRING_LIMP = 545, /* Springs have no stiffness and no effect: state a stiffness, or omit it to use the material's. */
  SBF_CODE_SPRING_IDLE = 546, /* Springs in a level of another model act only if they are marked extra: mark or remove them. */
  SBF_CODE_POINT_LOOSE = 547, /* Free points are not connected and fall: add springs, elements or a pin. */
  SBF_CODE_LEVEL_PIECES = 548, /* Parts of a level are not connected to a pin: join or pin them. */
  SBF_CODE_CROSS_SPRING_LEVEL = 549, /* Cross springs name a level that the body does not have: name one of its levels, from 0. */
  SBF_CODE_CROSS_SPRING_POINT = 550, /* A cross spring names a point that its level does not have: name points of the levels stated. */
  SBF_CODE_HULL_FLAT = 551, /* A section is too flat for a convex hull and has none: make it thicker if it should collide. */
  SBF_CODE_EMBEDDING_FLAT = 552, /* Vertices are outside a flat body and follow its surface: make the body enclose them if that is wrong. */
  SBF_CODE_EMBEDDING_NO_BODY = 553, /* No soft body deforms a mesh, so it moves with its bones only: make a section for its bones. */
  SBF_CODE_ATTACHMENT_NO_HULL = 554, /* An attachment names a rigid body without a hull, so no point is inside it: give the body a hull, or list the points. */
  SBF_CODE_BODY_WITHOUT_POINTS = 555, /* A soft body has no points, so nothing can be built for it: add a surface or remove the body. */
  SBF_CODE_CROSS_SPRING_ONE_BODY = 556, /* Cross springs join a body to itself: make them a spring set of its level. */
  SBF_CODE_SURFACE_CROSSES = 560, /* A surface intersects itself: separate the crossing polygons in the source. */
  SBF_CODE_SURFACE_UNWELDED = 561, /* Points at an open seam have the same position but are not joined, so the body separates there: weld them in the source. */
  SBF_CODE_INTERIOR_OUTSIDE = 562, /* An interior point is outside the surface: move it inside or remove it. */
  SBF_CODE_POLYGON_SIDE_EMPTY = 563, /* A polygon names a point twice in a row: remove one of the corners. */
  SBF_CODE_REGION_FLAT = 564, /* A shape region is a point, a line or a plane and can flip: add points outside it. */
  SBF_CODE_REGION_POINT_LEFT_OUT = 565, /* Free points are in no shape region: add them to one. */
  SBF_CODE_LEVEL_POINT_MOVED = 566, /* Points of a level are not where their source points are: build again. */
  SBF_CODE_LEVEL_MAP = 567, /* Two source points are one point of a level: build again. */
  SBF_CODE_LEVEL_ORDER = 568, /* A level is finer than the one before it: list the finest first. */
  SBF_CODE_EMBEDDING_OFF = 570, /* Embedded vertices differ from the mesh's rest positions and jump at the start: build again. */
  SBF_CODE_EMBEDDING_REPEATED = 571, /* An embedding names a vertex twice: keep one. */
  SBF_CODE_SKIN_BONE_REPEATED = 572, /* A point names one bone twice: add the two weights. */
  SBF_CODE_NORMALS_LENGTH = 573, /* The number of normals is not the number of points: add one per point, or index them by normal_corners. */
  SBF_CODE_NORMAL_NOT_UNIT = 574, /* A normal is not of unit length: normalize it, as --fix does. */
  SBF_CODE_UV_LENGTH = 575, /* The number of texture coordinates is not the number of points: add one per point, or index them by corners. */
  SBF_CODE_SHAPE_KEY_REPEATED = 576, /* A shape key names a point twice: add the two offsets. */
  SBF_CODE_RENDER_LEVEL_ORDER = 577, /* A render level has no fewer triangles than the one before it: list the finest first. */
  SBF_CODE_MESH_EMPTY = 578, /* A render mesh has no polygons and is invisible: add some or remove it. */
  SBF_CODE_MATERIAL_NO_UVS = 579, /* A mesh whose material has an image has no texture coordinates: unwrap it, or remove the image from the material. */
  SBF_CODE_WEIGHT_MAP_ZERO = 580, /* A weight map removes all mass or stiffness of a free point: use a factor above 0. */
  SBF_CODE_WEIGHT_MAP_IDLE = 581, /* A weight map scales an attribute that is 0: set the attribute or remove the map. */
  SBF_CODE_RENDER_LEVEL_CORNER = 582, /* A corner of a render level names a corner of the full mesh at another point: name one at the same point. */
  SBF_CODE_RENDER_LEVEL_ERROR = 583, /* A render level is farther from the full mesh than it states: state the true distance, or build it again. */
  SBF_CODE_MESH_POINT_UNUSED = 586, /* Points of a render mesh are in no polygon and only cost memory: remove them in the source, or by --fix. */
  SBF_CODE_COLORS_LENGTH = 588, /* The number of colors is not the number of points: add one per point, or index them by color_corners. */
  SBF_CODE_LATTICE_THIN = 590, /* Parts of a body are thinner than two elements, so the lattice is thicker than the body: use a smaller cell or more elements. */
  SBF_CODE_LATTICE_EMPTY = 591, /* A body encloses no volume that a lattice could fill, so springs over its surface are built: close the surface for a lattice. */
  SBF_CODE_LATTICE_TOO_FINE = 592, /* The cell is too small for the size of a body, or for all bodies together: use a larger cell or fewer elements. */
  SBF_CODE_EMBEDDING_FAR = 593, /* Vertices are more than a cell outside their lattice: use a smaller cell, or remove unused vertices from the source. */
  SBF_CODE_INTERIOR_TOO_MANY = 594, /* A body has too many points for springs between all of them: use another method. */
  SBF_CODE_LEVEL_OFF = 597, /* The displacement error of a lattice is more than a quarter under some load: use more elements. */
  SBF_CODE_LEVEL_ERROR_MISSED = 598, /* No coarse lattice reaches the requested error, so the body has as many elements as the reference: allow a larger error. */
  SBF_CODE_LEVEL_UNSETTLED = 599, /* A level does not come to rest under gravity, because parts rotate about their pins: use more elements, or pin more points. */
  SBF_CODE_BODY_NO_MASS = 601, /* A body that moves has no mass: state a density, an area density or a mass. */
  SBF_CODE_POISSON_UNSHOWN = 602, /* Springs cannot represent the material's Poisson ratio: use 0.25, or tetrahedra. */
  SBF_CODE_SUBSTEPS_TOO_FEW = 603, /* An explicit scheme is unstable with so few substeps: use at least the stated number. */
  SBF_CODE_UNIT_LOOKS_WRONG = 604, /* The asset's size suggests a wrong unit: convert the source with --unit. */
  SBF_CODE_DERIVED_STALE = 605, /* Derived parts were made from another source: run sbfmt build again, or --fix. */
  SBF_CODE_DENSITY_LOOKS_WRONG = 606, /* A density is implausible: state it in kg/m^3; water has 1000. */
  SBF_CODE_BODY_COLLAPSES = 607, /* A body cannot carry its own weight: raise young_modulus, which is in Pa, or lower the density. */
  SBF_CODE_POINT_NO_MASS = 608, /* A free point has no mass: add mass or pin it. */
  SBF_CODE_STRAIN_ORDER = 609, /* A strain limit prevents yield or tear: order them as yield, tear, strain_max. */
  SBF_CODE_GRAVITY_LOOKS_WRONG = 610, /* Gravity is implausible: state it in m/s^2, with +Y up. */
  SBF_CODE_FIELD_NO_DIRECTION = 611, /* A uniform field or a vortex has no direction and no effect: state one. */
  SBF_CODE_FOLLOWER_TOO_FAST = 612, /* A follower is faster than the control tick can resolve: lower its frequency. */
  SBF_CODE_FOLLOWER_UNDAMPED = 613, /* A follower without damping never stops: state a damping ratio. */
  SBF_CODE_COLLISION_SELF_MASKED = 614, /* A body should collide with itself, but its mask excludes its layer: add the layer to the mask. */
  SBF_CODE_COLLISION_ONE_SIDED = 615, /* Only one of two masks has the other's layer, so they never collide: put both layers into both masks. */
  SBF_CODE_PARTICLE_TOO_LARGE = 616, /* A particle radius is larger than the body: state it in metres. */
  SBF_CODE_PRESSURE_OPEN = 617, /* Pressure acts on closed surfaces only: close the surface or set the mode to none. */
  SBF_CODE_LEVEL_NOT_SIMULATED = 641, /* The runtime cannot simulate this elastic model: build the file with springs or tetrahedra. */
  SBF_CODE_TOO_STIFF = 642, /* A body is too stiff and light for explicit steps: use more mass, less stiffness or fewer points. */
  SBF_CODE_PART_LEFT_OUT = 643, /* The file has content that this runtime ignores: use another or a later runtime for it. */
  SBF_CODE_SCHEME_BIASED = 644, /* A body's scheme has a known error of more than a tenth: use `automatic`, or more substeps. */
  SBF_CODE_RIG_SECTION_GUESSED = 701, /* A section was assigned to the nearest bone, because no name matches: rename the object if that is wrong. */
  SBF_CODE_RIG_UNWEIGHTED_POINTS = 702, /* Points of a skinned mesh have no weights: paint them in the source. */
  SBF_CODE_RIG_NO_SECTIONS = 703, /* Every mesh is skinned: the build cuts sections. */
  SBF_CODE_RIG_NO_LEGS = 704, /* No chain of bones ends at the ground, so no gait is proposed: choose a kind with --gait. */
  SBF_CODE_RIG_BONE_REHUNG = 705, /* A bone with skin weights that was moved by hand is now a child of its limb: change its parent in the source if that is wrong. */
  SBF_CODE_SECTION_MERGED = 706, /* The part of a bone is too small for a section and joins another bone's part: no action is needed. */
  SBF_CODE_SECTION_OPEN = 707, /* A section cut from a skin could not be closed: remove edges with more than two polygons in the source. */
  SBF_CODE_SECTION_STRETCHED = 708, /* Triangles of a skin stretch much at a joint: smooth the weights there in the source. */
  SBF_CODE_RIG_CRAWLS = 709, /* No limb of the rig reaches the ground, so a chain that follows its first bone is proposed: choose another kind with --gait. */
  SBF_CODE_SECTION_NO_BONE = 710, /* A body of a file with a skeleton is not attached: name its bone or pin it. */
  SBF_CODE_SECTION_UNHELD = 711, /* A section has a bone and no pins: pin it, or build again. */
  SBF_CODE_NAME_REPEATED = 712, /* Two objects of one kind have the same name: rename one of them. */
  SBF_CODE_ROTATION_NOT_UNIT = 713, /* A rotation does not have unit length: normalize it, as --fix does. */
  SBF_CODE_HULL_NOT_CONVEX = 714, /* A hull is not convex: run sbfmt build, which makes one that is. */
  SBF_CODE_JOINT_FRAME = 715, /* A joint's frame is not orthonormal: normalize its rotation, as --fix does. */
  SBF_CODE_JOINT_ONE_BODY = 716, /* A joint joins a body to itself: name two bodies. */
  SBF_CODE_LIMIT_ORDER = 717, /* A limit has its minimum above its maximum: swap them. */
  SBF_CODE_IK_CHAIN_BROKEN = 718, /* The end of a chain is not below its root: choose a root above the end. */
  SBF_CODE_RIG_LIMITS_PROPOSED = 719, /* Joint limits are proposed from names and positions of bones: confirm or change them. */
  SBF_CODE_PIN_SET_EMPTY = 720, /* A pin set has no points: name some or remove it. */
  SBF_CODE_PIN_REPEATED = 721, /* A point is pinned twice, and the first pin counts: keep one, as --fix does. */
  SBF_CODE_PIN_RANGE = 722, /* A pin set's minimum is above its maximum: swap them. */
  SBF_CODE_PIN_TWO_FRAMES = 723, /* A pin set names two frames but can follow only one: keep the bone or the rigid body. */
  SBF_CODE_SECTION_FAR = 725, /* A section is far from its bone: check which bone it names. */
  SBF_CODE_IK_BONE_COUNT = 726, /* A two_bone chain does not have one bone between root and end: choose another root, end or solver. */
  SBF_CODE_IK_NO_BEND = 727, /* A straight chain has no pole to bend towards: add one off the line from root to end. */
  SBF_CODE_IK_COMFORT_OUTSIDE = 728, /* A comfort names a bone outside its chain: name one from root to end. */
  SBF_CODE_IK_NO_REACH = 729, /* A chain has no length: move the heads of its bones apart. */
  SBF_CODE_LEG_HOME_BEYOND_REACH = 730, /* A leg does not reach its home: place the home nearer or make the leg longer. */
  SBF_CODE_LEG_TRIGGER_BEYOND_REACH = 731, /* A leg cannot reach step_trigger from its home: lower step_trigger. */
  SBF_CODE_LEG_REPEATED = 732, /* Two legs share an IK chain: use one chain per leg. */
  SBF_CODE_GAIT_ONE_GROUP = 733, /* All legs are in one group and may leave the ground at once: spread them over two groups. */
  SBF_CODE_GAIT_NO_LEGS = 734, /* A gait has no legs: add some or remove it. */
  SBF_CODE_GAIT_BONE_OUTSIDE = 735, /* A bone of a gait is not below the gait's body: choose a body above it. */
  SBF_CODE_GAIT_STEP_TOO_SHORT = 736, /* A step is shorter than two control ticks: lengthen step_duration or shorten the tick. */
  SBF_CODE_GAIT_STEP_TOO_HIGH = 737, /* A step is higher than the leg is long: lower step_height. */
  SBF_CODE_LEG_UNEVEN = 738, /* The soles of the legs are not level at rest: check home and sole. */
  SBF_CODE_CHAIN_EMPTY = 740, /* A chain has fewer than two bones and nothing to move: name more or remove it. */
  SBF_CODE_CHAIN_BROKEN = 741, /* Bones of a chain are not parent and child in order: list them from the leading bone on. */
  SBF_CODE_BONE_REPEATED = 742, /* A list of bones names one twice: name it once. */
  SBF_CODE_FOLLOWER_REPEATED = 743, /* Two followers move one property of a bone: keep one. */
  SBF_CODE_CLIP_TIMES = 744, /* Times of keys do not increase, or begin below 0: sort the keys. */
  SBF_CODE_CLIP_VALUES = 745, /* A track has the wrong number of values for its keys: see the element track in the reference. */
  SBF_CODE_CLIP_EMPTY = 746, /* A clip has nothing to play: add tracks with keys or remove it. */
  SBF_CODE_CLIP_PAST_END = 747, /* Keys are after the end of their clip and never play: lengthen it or remove them. */
  SBF_CODE_CLIP_TRACK_REPEATED = 748, /* Two tracks of a clip key one property of a bone: keep one. */
  SBF_CODE_CLIP_SCALE = 749, /* A key has a zero or negative scale: keep scales above 0. */
  SBF_CODE_POSE_REPEATED = 750, /* A pose sets a bone twice: keep one. */
  SBF_CODE_POSE_DISTANCE = 751, /* Two poses of a walk have the same distance, or one is negative: use different distances of at least 0. */
  SBF_CODE_POSE_EMPTY = 752, /* A pose sets no bone: add keys or remove it. */
  SBF_CODE_HULL_OPEN = 753, /* A hull is not closed: run sbfmt build, which makes one that is. */
  SBF_CODE_INERTIA_IMPOSSIBLE = 754, /* The principal moments are impossible: each must be at most the sum of the other two. */
  SBF_CODE_CENTER_OUTSIDE = 755, /* A rigid body's center is outside its hull: check its position, or leave the inertia out. */
  SBF_CODE_JOINT_NOT_AT_REST = 756, /* A joint does not match the rest pose and jerks at the start: move both frames to the same position. */
  SBF_CODE_LIMIT_IDLE = 757, /* A limit is on a motion that the joint does not have: remove it or choose another kind of joint. */
  SBF_CODE_LIMIT_REPEATED = 758, /* Two limits are on one motion: keep the narrower. */
  SBF_CODE_LIMIT_BEYOND_RANGE = 759, /* A limit is outside the range of its motion: state angles in radians, distances above 0. */
  SBF_CODE_LIMIT_EXCLUDES_REST = 760, /* The rest pose is outside a limit and jerks at the start: widen the limit or move the frames. */
  SBF_CODE_DRIVE_IDLE = 761, /* A drive is on a locked motion, or has neither stiffness nor damping: remove or change it. */
  SBF_CODE_PULLEY_NO_ROPE = 762, /* A pulley joint has no rope: move pulley_a and pulley_b away from the frames of the bodies. */
  SBF_CODE_PIN_NO_WEIGHT = 763, /* All weights of a pin set are 0, so it has no effect: raise weights or minimum. */
  SBF_CODE_PIN_OFFSET = 764, /* Pins move points far from their rest position: check the offsets, which are in the frame of the bone or body. */
  SBF_CODE_ATTACHMENT_EMPTY = 765, /* An attachment contains no point: move the hull around some, or list them. */
  SBF_CODE_CHAIN_SPRING_REPEATED = 766, /* Two chains with springs swing one bone: keep one. */
  SBF_CODE_CHAIN_CENTER = 767, /* The center of a swinging chain is not its first bone or above it: choose a bone that is. */
  SBF_CODE_CHAIN_COLLIDER_NORMAL = 768, /* A plane that ends of chains collide with has no direction: state a normal. */
  SBF_CODE_RIG_ALIGNED = 781, /* The input was scaled, rotated or moved onto the rig: state its unit and axes if that is wrong. */
  SBF_CODE_RIG_WEIGHTS = 782, /* Points of the input were assigned to bones, by name, position, nearest surface, from the bones or from a file: change that with --weights. */
  SBF_CODE_RIG_MISFIT = 783, /* The rig does not fit the input: use the character's own rig, state its unit and axes, or choose other weights. */
  SBF_CODE_RIG_WEIGHTS_FILE = 784, /* A file of weights has an unknown bone or point, or an invalid number: correct the line given. */
  SBF_CODE_RIG_WEIGHTS_LOST = 785, /* Weights of points do not sum to one, for example because joints are missing, and are scaled: export the skin again. */
  SBF_CODE_RIG_OBJECT_APART = 786, /* No bone is inside or near an object with computed weights: if it is another character, convert it with its own rig. */
  SBF_CODE_SOFTNESS_PROPOSED = 787, /* Soft and rigid parts of the character were chosen: change them with --soft and --rigid. */
  SBF_CODE_RIG_OTHER_MESH = 788, /* The rig's own mesh differs from the input, or bones are outside it: use the rig of this character in the same pose, or --weights compute or transfer if it is right. */
  SBF_CODE_GAIT_NOTHING_MOVES = 790, /* A gait has no part that its kind moves: add one, or choose kind none. */
  SBF_CODE_GAIT_CHAIN_SHORT = 791, /* A wave or a tread needs at least two bones, a fin at least one: name them. */
  SBF_CODE_GAIT_AXIS_ZERO = 792, /* An axis has no length: state a direction. */
  SBF_CODE_GAIT_POSE_WALKS = 793, /* A rest pose has a walking distance: remove the distance, or choose another pose. */
  SBF_CODE_GAIT_KIND = 794, /* The gait was chosen from shape, names and clips: change it with --gait. */
  SBF_CODE_GAIT_KIND_UNSURE = 795, /* Two gaits are about as likely: choose one with --gait. */
  SBF_CODE_REST_POSE_PROPOSED = 796, /* A pose for standing and moving is proposed: confirm or change the gait's rest_pose. */
  SBF_CODE_RIG_OTHER_SKELETON = 797, /* The file has several characters, and the gait moves one: export each to its own file. */
  SBF_CODE_RIG_LIES = 798, /* The legs of the rig do not point down, as if it lies or stands on its head: state --up, or rotate it in its program. */
  SBF_CODE_PACKED_MAGIC = 801, /* The file has no packed header: copy it again in binary mode, or use a file of this format. */
  SBF_CODE_PACKED_TRUNCATED = 802, /* The file ends before its last chunk, so it was truncated: copy it again. */
  SBF_CODE_PACKED_TABLE = 803, /* The header or the table of contents is inconsistent, so the file is damaged: copy or pack it again. */
  SBF_CODE_PACKED_CRC = 804, /* The bytes of a chunk do not match their CRC-32, so the file is damaged: copy it again. */
  SBF_CODE_PACKED_INFLATE = 805, /* A chunk does not inflate to the size in its entry, so the file is damaged: copy it again. */
  SBF_CODE_PACKED_RATIO = 806, /* A chunk inflates to more than the limit: raise the limit if the file is trusted. */
  SBF_CODE_PACKED_RECORD = 807, /* A record is inconsistent, so the file is damaged: copy or pack it again. */
  SBF_CODE_PACKED_CODEC = 808, /* A chunk uses an unknown codec or filter: update the library. */
  SBF_CODE_PACKED_UNKNOWN_PART = 809, /* A critical part has an unknown kind: update the library. */
  SBF_CODE_GLTF_SYNTAX = 821, /* The file is no valid binary glTF 2.0 in one piece: copy or export it again. */
  SBF_CODE_GLTF_NO_SOFT_BODY = 822, /* The glTF file lacks the extension SBF_soft_body: make a bundle of it with `sbfmt convert`. */
  SBF_CODE_GLTF_EXTENSION = 823, /* The content of the extension SBF_soft_body is inconsistent: pack the character again. */
  SBF_CODE_GLTF_CHANGED = 824, /* Another program changed the meshes or clips that SBF_soft_body refers to: use the file as it was before. */
  SBF_CODE_GLTF_RENUMBERED = 825, /* Another program renumbered the meshes, clips or images of the glTF file: write the file again by `sbfmt validate --fix`. */
  SBF_CODE_IMPORT_SYNTAX = 901, /* A line of a text file is malformed: correct it or export it again. */
  SBF_CODE_IMPORT_INDEX = 902, /* A polygon refers to a vertex, normal or texture coordinate that the file does not have: export it again. */
  SBF_CODE_IMPORT_NOT_FINITE = 903, /* A number of the imported file is infinite or not a number: export it again. */
  SBF_CODE_IMPORT_POLYGON = 904, /* A polygon has fewer than three corners, or more than 65,535: divide it. */
  SBF_CODE_IMPORT_EMPTY = 905, /* The imported file has neither a surface nor bones: export polygons or a skeleton. */
  SBF_CODE_IMPORT_REFUSED = 906, /* The importer of this format refuses the file: export it as a current FBX, glTF 2.0 or OBJ. */
  SBF_CODE_IMPORT_CRASHED = 907, /* The importer crashed on the file, which is damaged or unusual: export it again or in another format. */
  SBF_CODE_IMPORT_LIMIT = 908, /* The importer exceeded a limit of time, memory or output: raise the limit if the file is trusted. */
  SBF_CODE_IMPORT_HELPER_MISSING = 909, /* The program sbfmt-import cannot be found or run: install it beside sbfmt or set SBFMT_IMPORT_HELPER. */
  SBF_CODE_IMPORT_STREAM = 910, /* The output of sbfmt-import cannot be read, because it has another version or was truncated: install both programs from one version. */
  SBF_CODE_IMPORT_PHYSICS = 911, /* KHR_physics_rigid_bodies or KHR_implicit_shapes of the imported glTF file is invalid: correct it in the program that wrote the file. */
  SBF_CODE_IMPORT_MATERIALS_MISSING = 931, /* A material library or a material of the file is missing, so gray is used: put the library beside the file. */
  SBF_CODE_IMPORT_IGNORED = 932, /* The file has content that the format cannot store, which is skipped: no action is needed if you do not need it. */
  SBF_CODE_IMPORT_POINTS_LEFT_OUT = 933, /* Vertices that no polygon uses are left out: join them to polygons if you need them. */
  SBF_CODE_IMPORT_MESH_INVENTED = 934, /* The importer invented a mesh for a file without one, and it is left out: convert the mesh file with this one as --rig. */
  SBF_CODE_IMPORT_NAME_AMBIGUOUS = 935, /* Several nodes have the name to which a skin or a clip refers: give each node its own name. */
  SBF_CODE_IMPORT_AXES = 936, /* The file's axes do not form a frame, so +Y up is assumed: state --up and --forward if that is wrong. */
  SBF_CODE_IMPORT_KEYS = 937, /* Inconsistent keys of an animation are left out: export the animation again. */
  SBF_CODE_IMPORT_IMAGE = 938, /* An image cannot be imported: save it as PNG or JPEG. */
  SBF_CODE_IMPORT_UNIT = 939, /* The file states no usable unit, so metres are assumed: state --unit if that is wrong. */
  SBF_CODE_IMPORT_POSE = 940, /* The file was saved in mid-motion: the bind pose is used. */
  SBF_CODE_IMPORT_POINTS_JOINED = 941, /* Vertices that were split for rendering are joined: they have one position and move together. */
  SBF_CODE_IMPORT_MOTION = 942, /* A clip of a motion file was transferred: the message lists its bones and distance. */
  SBF_CODE_IMPORT_MOTION_UNMATCHED = 943, /* Bones have no counterpart in the other skeleton, so their motion is lost or they follow their parents: use equal bone names, or add retarget chains. */
  SBF_CODE_IMPORT_MOTION_NONE = 944, /* A motion file has no clip, or none of its bones matches the skeleton: use equal bone names, or add retarget chains. */
  SBF_CODE_IMPORT_NO_MESH = 950, /* The file has a skeleton and no mesh: convert a mesh file with this one as --rig. */
  SBF_CODE_IMPORT_NO_RIG = 951, /* The file has no skeleton, so no body is pinned to a bone: add a skeleton with --rig. */
  SBF_CODE_IMPORT_NO_BONES = 952, /* The rig file has no skeleton: use a file with bones. */
  SBF_CODE_IMPORT_PARTIAL_UVS = 953, /* A set of texture coordinates does not cover the whole mesh and was dropped: unwrap the whole mesh. */
  SBF_CODE_IMPORT_INSIDE_OUT = 954, /* All polygons of a closed surface faced inwards and were reversed: correct their orientation in the source. */
  SBF_CODE_IMPORT_GROUND = 955, /* The character was not on y = 0, or not at the origin, and was moved there: no action is needed. */
  SBF_CODE_IMPORT_PIN_UNKNOWN = 956, /* A pin or an attachment names a group, an object or a bone that the input does not have: sbfmt info lists them. */
  SBF_CODE_MATERIAL_GUESSED = 957, /* Bodies without a material use soft tissue for sections, else the default or a modulus that carries their weight: choose one with --material. */
  SBF_CODE_IMPORT_FACING = 958, /* The character did not face +Z and was rotated: state --forward if that is wrong. */
  SBF_CODE_IMPORT_FAR = 959, /* An object is so far from the origin that single precision rounds its shape: move it to the origin in its program. */
  SBF_CODE_IMPORT_TETRAHEDRA_TURNED = 960, /* Tetrahedra were inverted and their points were reordered: no action is needed. */
  SBF_CODE_IMPORT_TETRAHEDRA_FLAT = 961, /* Tetrahedra without volume were left out: mesh the volume again if parts are missing. */
  SBF_CODE_IMPORT_SPRING = 962, /* A spring bone, a collider or a humanoid bone of a VRM file is malformed: correct it in the program that wrote the file. */
  SBF_CODE_IMPORT_WEIGHTS_IMPOSSIBLE = 970, /* Skin weights cannot be computed: use a mesh with a surface, and a rig with bones that deform it. */
  SBF_CODE_IMPORT_RIG_OUTSIDE = 971, /* Less than 60 % of the rig's bone length is inside the mesh near some of its surface, or less than 85 % after its limbs were rotated: use the rig of this mesh in its pose, or state --unit, --up and --forward. */
  SBF_CODE_IMPORT_WEIGHTS_COMPUTED = 972, /* The rig has no mesh with weights, so weights were computed from its bones: choose another source with --weights. */
  SBF_CODE_EXPORT_EMPTY = 980, /* The asset has nothing that the output format can store: choose another format. */
  SBF_CODE_EXPORT_LEFT_OUT = 981, /* The output format cannot store parts of the asset, which are left out: choose another format if you need them. */
  SBF_CODE_EXPORT_PAGE_MISSING = 982, /* Files of the web page cannot be found: build sbfmt with clang for WebAssembly, or set SBFMT_WEB. */
} sbf_code;
// clang-format on

/* Information about a code. */
typedef struct sbf_code_info {
  const char *name;      /* as in reports */
  sbf_code code;         /* its number */
  sbf_severity severity; /* its severity */
  sbf_status fault;      /* SBF_BAD_INPUT or SBF_FAILED */
  const char *text;      /* its meaning and what to do next */
} sbf_code_info;

/* Information about a code; NULL for an unknown number. */
SBF_API const sbf_code_info *sbf_code_find(int32_t code);

/* All codes, ordered by number; `*count` receives how many. */
SBF_API const sbf_code_info *sbf_code_table(uint32_t *count);

#ifdef __cplusplus
}
#endif
#endif

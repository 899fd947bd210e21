extends Node3D
# The mouse: a click on a character pushes it there and says which bone was hit; a click on the ground sends the lizard there; the right
# button takes hold of what is soft and drags it.

const PUSH := 0.35 # N s

@onready var lizard: SoftCharacter3D = $"../Lizard"
@onready var camera: Camera3D = $"../Camera"
@onready var words: Label = $"../Hit"
var held: SoftCharacter3D
var depth := 0.0
var goal := Vector3.INF


func hit_at(pointer: Vector2) -> Dictionary:
	var from := camera.project_ray_origin(pointer)
	return get_world_3d().direct_space_state.intersect_ray(PhysicsRayQueryParameters3D.create(from, from + 20 * camera.project_ray_normal(pointer)))


func _unhandled_input(event: InputEvent) -> void:
	if event is InputEventMouseMotion and held:
		held.drag(camera.project_position(event.position, depth))
	if not event is InputEventMouseButton:
		return
	if held and not event.pressed:
		held.release()
		held = null
	var hit := hit_at(event.position) if event.pressed else {}
	if not hit:
		return
	var character := hit.collider as SoftCharacter3D
	if event.button_index == MOUSE_BUTTON_RIGHT and character:
		depth = -(camera.global_transform.affine_inverse() * hit.position).z
		if character.grab(hit.position): held = character
	elif event.button_index == MOUSE_BUTTON_LEFT and character:
		character.apply_impulse(hit.position, PUSH * camera.project_ray_normal(event.position))
		words.text = "%s %s" % [character.name, character.get_bone_of_shape(hit.shape)]
	elif event.button_index == MOUSE_BUTTON_LEFT and hit.collider is StaticBody3D:
		goal = hit.position


# Whether the lizard is on its way to where was clicked.
func leads(speed: float) -> bool:
	var way := goal - lizard.global_position
	way.y = 0
	if not goal.is_finite() or way.length() < 0.1:
		goal = Vector3.INF
		return false
	lizard.velocity = way.normalized() * speed
	lizard.move_and_slide()
	return true

extends Node3D
# Keys drive the character, the camera goes along, and where feet come down is marked for a moment. Its head turns to the nearest ball, and the
# gate is lit while it is inside.

const WALK := 0.3
const RUN := 0.6
const TURN := 0.9

@onready var lizard: SoftCharacter3D = $Lizard
@onready var camera: Camera3D = $Camera
var steps := 0


func _ready() -> void:
	lizard.foot_down.connect(_on_foot_down)
	$Gate.body_entered.connect(func(body: Node3D): if body == lizard: light_gate(true))
	$Gate.body_exited.connect(func(body: Node3D): if body == lizard: light_gate(false))


func _physics_process(_delta: float) -> void:
	var ahead := Input.get_axis("ui_down", "ui_up") + float(Input.is_physical_key_pressed(KEY_W)) - float(Input.is_physical_key_pressed(KEY_S))
	var aside := Input.get_axis("ui_right", "ui_left") + float(Input.is_physical_key_pressed(KEY_A)) - float(Input.is_physical_key_pressed(KEY_D))
	var speed := RUN if Input.is_key_pressed(KEY_SHIFT) else WALK
	if ahead or aside: $Hand.goal = Vector3.INF
	lizard.set_look_target("head", nearest_ball())
	if $Hand.leads(speed):
		return
	lizard.drive(clampf(ahead, -1, 1) * speed, 0, clampf(aside, -1, 1) * TURN)


func _unhandled_key_input(event: InputEvent) -> void:
	if event.is_action_pressed("ui_select"):
		lizard.knock_over()
	elif event is InputEventKey and event.pressed and event.physical_keycode == KEY_R:
		lizard.reset_pose()
	elif event is InputEventKey and event.pressed and event.physical_keycode == KEY_N:
		$Nod.nod()


func nearest_ball() -> Vector3:
	var near := Vector3.INF
	for i in range(1, 5):
		var at: Vector3 = get_node("Ball%d" % i).global_position
		if not near.is_finite() or at.distance_to(lizard.position) < near.distance_to(lizard.position): near = at
	return near


func light_gate(on: bool) -> void:
	$Gate/Seen.mesh.material.albedo_color = Color(1, 0.85, 0.3, 0.45) if on else Color(0.5, 0.6, 0.8, 0.25)


func _process(delta: float) -> void:
	# From its left, a little ahead and above; it lags, so that the walk is seen to move.
	var from := lizard.position + Vector3(0.95, 0.5, 0.55)
	camera.position = camera.position.lerp(from, 1 - exp(-3 * delta))
	camera.look_at(lizard.position + Vector3(0, 0.1, 0))


func _on_foot_down(_leg: int, at: Vector3) -> void:
	steps += 1
	var mark := MeshInstance3D.new()
	mark.mesh = CylinderMesh.new()
	mark.mesh.top_radius = 0.02
	mark.mesh.bottom_radius = 0.02
	mark.mesh.height = 0.002
	mark.position = at
	add_child(mark)
	get_tree().create_timer(2.0).timeout.connect(mark.queue_free)

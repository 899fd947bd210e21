extends "checks.gd"
# The script of docs/godot.md on a node of a scene with a floor: a character walks.

var scene: Node3D


func _initialize() -> void:
	add_box("StaticBody3D", Vector3(20, 1, 20), Vector3(0, -0.5, 0))
	scene = Node3D.new()
	scene.set_script(load("res://main.gd"))
	root.add_child(scene)


func _physics_process(_delta: float) -> bool:
	frame += 1
	if frame < 300:
		return false
	var walkers := scene.get_children().filter(func(one): return one is SoftCharacter3D)
	check(walkers.size() == 1, "%d characters" % walkers.size())
	check(walkers[0].get_travelled() > 1.0 and walkers[0].position.z > 1.0, "it went %f m" % walkers[0].get_travelled())
	finish()
	return true

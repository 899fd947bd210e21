extends Node3D
# The main script of a packed game: what it says of itself and of ten seconds of walk is compared with the program's.

var frame := 0
@onready var lizard: SoftCharacter3D = $Lizard


func _physics_process(_delta: float) -> void:
	frame += 1
	if frame <= 600:
		return
	print("state %s" % lizard.get_state_hash())
	print("beside it %s" % ", ".join(DirAccess.get_files_at("res://addons/sbfmt")))
	get_tree().quit()

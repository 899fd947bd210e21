extends "checks.gd"
# What a file's materials look like: bumps of a normal map by where the light is, colours of vertices, turned pictures, holes, glass, light of their
# own, both sides; and materials of the game in their place.

const NAMES := ["bumpy", "tinted", "turned", "holed", "glass", "shining", "back", "spun"]
var plates: SoftCharacter3D
var camera := Camera3D.new()
var sun := DirectionalLight3D.new()
var waited := 0
var scene := 0


func _initialize() -> void:
	plates = SoftCharacter3D.new()
	plates.asset = load("res://plates.sbfz")
	plates.ground = SoftCharacter3D.GROUND_FLAT
	root.add_child(plates)
	var world := WorldEnvironment.new()
	world.environment = Environment.new()
	world.environment.background_mode = Environment.BG_COLOR
	world.environment.background_color = Color(0, 0, 1)
	world.environment.ambient_light_source = Environment.AMBIENT_SOURCE_COLOR
	world.environment.ambient_light_color = Color(1, 1, 1)
	world.environment.ambient_light_energy = 0.1
	root.add_child(world)
	root.add_child(camera)
	root.add_child(sun)
	camera.projection = Camera3D.PROJECTION_ORTHOGONAL
	camera.size = 7
	camera.position = Vector3(5.75, 0.5, 5)
	root.size = Vector2i(1200, 640)
	shine_from(Vector3(1, 0, 1))


func shine_from(where: Vector3) -> void:
	sun.look_at_from_position(where, Vector3.ZERO)


# Colour of the picture at a place of a plate, from its lower left corner.
func at(picture: Image, name: String, x: float, y: float) -> Color:
	var point := camera.unproject_position(Vector3(1.5 * NAMES.find(name) + x, y, 0))
	return picture.get_pixelv(Vector2i(point))


func _process(_delta: float) -> bool:
	waited += 1
	if waited < 4:
		return false
	waited = 0
	scene += 1
	var picture := root.get_texture().get_image()
	match scene:
		1:
			light_from_the_right(picture)
			picture.save_png(OS.get_cmdline_user_args()[0])
			shine_from(Vector3(0.01, 1, 1))
		2:
			var up := at(picture, "bumpy", 0.25, 0.25).r
			var down := at(picture, "bumpy", 0.75, 0.25).r
			check(up > down + 0.2, "lit from above, what slopes up is %f, what slopes down %f" % [up, down])
			# Turned coordinates: the picture's left is above, its top at the right.
			check(at(picture, "spun", 0.75, 0.25).r > at(picture, "spun", 0.75, 0.75).r + 0.2, "turned bumps, lit from above")
			var white := StandardMaterial3D.new()
			white.shading_mode = BaseMaterial3D.SHADING_MODE_UNSHADED
			plates.surface_materials = {"tinted/0": white, "Nose/0": white}
			check(plates.surface_materials.size() == 2, "materials of surfaces")
			plates.scheme = SoftCharacter3D.SCHEME_POSITION_BASED # made anew
			plates.surface_materials = {"tinted/0": white}
		3:
			check(at(picture, "tinted", 0.5, 0.5).is_equal_approx(Color.WHITE), "the surface's material: %s" % at(picture, "tinted", 0.5, 0.5))
			var red := StandardMaterial3D.new()
			red.shading_mode = BaseMaterial3D.SHADING_MODE_UNSHADED
			red.albedo_color = Color.RED
			plates.surface_materials = {}
			plates.material_override = red
		4:
			for name: String in NAMES.filter(func(one): return one != "back"): check(at(picture, name, 0.5, 0.5).is_equal_approx(Color.RED), "all in red: %s is %s" % [name, at(picture, name, 0.5, 0.5)])
			finish()
	return scene == 4


func light_from_the_right(picture: Image) -> void:
	var right := at(picture, "bumpy", 0.25, 0.75).r
	var left := at(picture, "bumpy", 0.75, 0.75).r
	check(right > left + 0.2, "lit from the right, what slopes to the right is %f, to the left %f" % [right, left])
	check(at(picture, "spun", 0.25, 0.75).r > at(picture, "spun", 0.25, 0.25).r + 0.2, "turned bumps, lit from the right")
	var first := at(picture, "tinted", 0.05, 0.5)
	var last := at(picture, "tinted", 0.95, 0.5)
	check(first.r > 2 * first.g and last.g > 2 * last.r, "colours of vertices: %s, %s" % [first, last])
	var top := at(picture, "turned", 0.5, 0.8)
	var bottom := at(picture, "turned", 0.5, 0.2)
	check(top.r > 2 * top.b and bottom.b > 2 * bottom.r, "the turned picture: above %s, below %s" % [top, bottom])
	check(at(picture, "holed", 0.25, 0.5).is_equal_approx(Color(0, 0, 1)) and at(picture, "holed", 0.75, 0.5).r > 0.2, "the hole: %s, %s" % [
			at(picture, "holed", 0.25, 0.5), at(picture, "holed", 0.75, 0.5)])
	var glass := at(picture, "glass", 0.5, 0.5)
	check(glass.b > 0.8 and glass.r > 0.1 and glass.r < 0.9, "glass: %s" % glass)
	check(at(picture, "shining", 0.5, 0.5).g > 0.5, "its own light: %s" % at(picture, "shining", 0.5, 0.5))
	check(at(picture, "back", 0.5, 0.5).r > 0.05, "the back: %s" % at(picture, "back", 0.5, 0.5))

extends StaticBody3D
# Uneven ground: what is seen and what is stood on are the same squares.

const CELLS := 160
const CELL := 0.1
const STEEP := 0.14

var noise := FastNoiseLite.new()


func height(x: float, z: float) -> float:
	# Level where the character begins.
	var far := smoothstep(0.3, 1.2, Vector2(x, z).length())
	return STEEP * far * noise.get_noise_2d(x, z)


func _ready() -> void:
	noise.seed = 7
	noise.frequency = 0.9
	var tool := SurfaceTool.new()
	tool.begin(Mesh.PRIMITIVE_TRIANGLES)
	for j in CELLS + 1:
		for i in CELLS + 1:
			var x := (i - CELLS / 2.0) * CELL
			var z := (j - CELLS / 2.0) * CELL
			var y := height(x, z)
			tool.set_color(Color(0.42, 0.5, 0.3).lerp(Color(0.62, 0.55, 0.42), clampf(y / STEEP + 0.5, 0, 1)) * (0.94 if (i + j) % 2 else 1.0))
			tool.add_vertex(Vector3(x, y, z))
	for j in CELLS:
		for i in CELLS:
			var a := j * (CELLS + 1) + i
			for corner in [a, a + 1, a + CELLS + 1, a + 1, a + CELLS + 2, a + CELLS + 1]:
				tool.add_index(corner)
	tool.generate_normals()
	var surface := MeshInstance3D.new()
	surface.mesh = tool.commit()
	var paint := StandardMaterial3D.new()
	paint.vertex_color_use_as_albedo = true
	paint.roughness = 0.95
	surface.material_override = paint
	add_child(surface)
	var form := CollisionShape3D.new()
	form.shape = surface.mesh.create_trimesh_shape()
	add_child(form)

// A project of Godot's as the pack (.pck) that its web template boots: the filter over a picture, in a viewport of its own.

const SCRIPT = `extends Node

func _ready() -> void:
	var image := Image.new()
	image.load_png_from_buffer(FileAccess.get_file_as_bytes("res://in.png"))
	var viewport := SubViewport.new()
	viewport.size = image.get_size()
	viewport.disable_3d = true
	# Or its texels have 10 bits, and those of the picture 8.
	viewport.transparent_bg = true
	viewport.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	viewport.canvas_item_default_texture_filter = Viewport.DEFAULT_CANVAS_ITEM_TEXTURE_FILTER_NEAREST
	add_child(viewport)
	var picture := TextureRect.new()
	picture.texture = ImageTexture.create_from_image(image)
	viewport.add_child(picture)
	# As the README says: a ColorRect over all, with the shader.
	var layer := CanvasLayer.new()
	viewport.add_child(layer)
	var filter := ColorRect.new()
	filter.size = image.get_size()
	var material := ShaderMaterial.new()
	material.shader = load("res://filter.gdshader")
	var values: Dictionary = JSON.parse_string(FileAccess.get_file_as_string("res://uniforms.json"))
	for value in values:
		material.set_shader_parameter(value, values[value])
	filter.material = material
	layer.add_child(filter)
	for frame in 6:
		await RenderingServer.frame_post_draw
	var made := viewport.get_texture().get_image()
	made.convert(Image.FORMAT_RGBA8)
	JavaScriptBridge.eval("globalThis.godotPicture = '%s'" % Marshalls.raw_to_base64(made.get_data()), true)
`;

const SCENE = `[gd_scene load_steps=2 format=3]

[ext_resource type="Script" path="res://main.gd" id="1"]

[node name="Main" type="Node"]
script = ExtResource("1")
`;

const PROJECT = `config_version=5

[application]

config/name="filter"
run/main_scene="res://main.tscn"
config/features=PackedStringArray("4.6", "GL Compatibility")

[rendering]

renderer/rendering_method="gl_compatibility"
renderer/rendering_method.web="gl_compatibility"
renderer/rendering_method.mobile="gl_compatibility"
`;

/** The pack of a project with a shader, a picture (a PNG) and values of uniforms. */
export function pack(shader, png, uniforms) {
    const files = Object.entries({
        "project.godot": PROJECT, "main.tscn": SCENE, "main.gd": SCRIPT,
        "filter.gdshader": shader, "in.png": png, "uniforms.json": JSON.stringify(uniforms),
    }).map(([name, contents]) => [name, Buffer.from(contents)]);
    const base = 112;
    const head = Buffer.alloc(base);
    head.write("GDPC");
    // Format 3 of Godot 4.6.0, whose offsets count from the first file.
    [3, 4, 6, 0, 2].forEach((number, k) => head.writeUInt32LE(number, 4 + 4 * k));
    head.writeBigUInt64LE(BigInt(base), 24);
    const listed = [];
    const count = Buffer.alloc(4);
    count.writeUInt32LE(files.length);
    listed.push(count);
    let offset = 0;
    const contents = files.map(([name, bytes]) => {
        const path = Buffer.alloc(Math.ceil((name.length + 1) / 4) * 4);
        path.write(name);
        const entry = Buffer.alloc(4 + path.length + 36);
        entry.writeUInt32LE(path.length);
        path.copy(entry, 4);
        entry.writeBigUInt64LE(BigInt(offset), 4 + path.length);
        entry.writeBigUInt64LE(BigInt(bytes.length), 12 + path.length);
        listed.push(entry);
        const padded = Buffer.alloc(Math.ceil(bytes.length / 16) * 16);
        bytes.copy(padded);
        offset += padded.length;
        return padded;
    });
    head.writeBigUInt64LE(BigInt(base + offset), 32);
    return Buffer.concat([head, ...contents, ...listed]);
}

//! Good files give the right triangles; bad ones an error that names the trouble.

use super::*;
use std::fs;
use std::path::PathBuf;

/// A folder that goes when the test ends.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("straightline-load-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).expect("a folder for the test");
        Scratch(path)
    }

    fn file(&self, name: &str, contents: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join(name);
        fs::write(&path, contents).expect("a file for the test");
        path
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn refusal(path: &Path) -> String {
    load_scene(path).expect_err("a refusal").to_string()
}

const QUAD: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

/// A glTF file of one triangle, in a buffer of 3 positions and 3 indices of 16 bits; `change` edits the text.
fn write_triangle(scratch: &Scratch, change: impl Fn(String) -> String) -> PathBuf {
    let numbers: [f32; 9] = [0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 2.0, 0.0];
    let mut bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    bytes.extend([0, 0, 1, 0, 2, 0, 0, 0]);
    scratch.file("data.bin", bytes);
    let text = r#"{
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "rotation": [0, 1, 0, 0], "children": [1]}, {"name": "leaf"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 1]}}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [2, 2, 0]},
            {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
        "buffers": [{"byteLength": 44, "uri": "data.bin"}]
    }"#;
    scratch.file("triangle.gltf", change(text.to_owned()))
}

#[test]
fn an_obj_is_triangulated_lit_and_framed() {
    let scratch = Scratch::new("obj");
    scratch.file("paint.mtl", "newmtl red\nKd 0.8 0.1 0.2\n");
    let path = scratch.file("quad.OBJ", format!("mtllib paint.mtl\nusemtl red\n{QUAD}"));
    let scene = load_scene(&path).expect("a scene");
    assert_eq!(scene.triangles.len(), 2);
    assert!(scene.vertices.iter().all(|vertex| vertex.color == [0.8, 0.1, 0.2]));
    assert!(scene.vertices.iter().all(|vertex| vertex.normal == [0.0, 0.0, 1.0]));
    // A diagonal of 10 units around the origin.
    let reach = scene.vertices.iter().map(|vertex| Vec3::from(vertex.position).length());
    assert!(reach.into_iter().all(|reach| (reach - 5.0).abs() < 1.0e-5));
}

#[test]
fn a_viewpoint_is_in_the_models_own_space() {
    let scratch = Scratch::new("viewpoint");
    // A diagonal of 5 around (101.5, 2, 0), which becomes one of 10 around the origin.
    let path = scratch.file("quad.obj", "v 100 0 0\nv 103 0 0\nv 103 4 0\nv 100 4 0\nf 1 2 3 4\n");
    let viewpoint = Viewpoint {
        eye: Some(Vec3::new(101.5, 2.0, 3.0)),
        target: Some(Vec3::new(103.0, 2.0, 0.0)),
        vertical_fov: Some(0.5),
    };
    let camera = load_seen(&path, &viewpoint).expect("a scene").camera;
    let near = |a: [f32; 3], b: [f32; 3]| (Vec3::from(a) - Vec3::from(b)).length() < 1.0e-5;
    assert!(
        near(camera.position, [0.0, 0.0, 6.0]) && near(camera.target, [3.0, 0.0, 0.0]),
        "{camera:?}"
    );
    assert_eq!(camera.vertical_fov, 0.5);
    let nowhere = Viewpoint {
        target: viewpoint.eye,
        ..viewpoint
    };
    let refused = load_seen(&path, &nowhere).expect_err("a refusal").to_string();
    assert!(refused.contains("view direction"), "{refused}");
}

#[test]
fn gltf_of_the_first_version_is_named() {
    let scratch = Scratch::new("first");
    let named = r#"{"asset": {"version": "1.0"}, "scene": "s", "scenes": {"s": {"nodes": []}}, "meshes": {}}"#;
    // The version was optional then.
    let unnamed = r#"{"scene": "s", "scenes": {"s": {"nodes": []}}, "meshes": {"m": {"primitives": []}}}"#;
    let binary = [&b"glTF"[..], &1u32.to_le_bytes(), &20u32.to_le_bytes(), &[0; 8]].concat();
    for (file, bytes) in [
        ("a.gltf", named.as_bytes()),
        ("b.gltf", unnamed.as_bytes()),
        ("c.glb", &binary),
    ] {
        let refused = refusal(&scratch.file(file, bytes));
        assert!(
            refused.contains("glTF 1.0") && refused.contains("gltf-pipeline"),
            "{refused}"
        );
    }
    let other = refusal(&scratch.file("d.gltf", "{"));
    assert!(!other.contains("glTF 1.0"), "{other}");
}

#[test]
fn textures_lie_on_surfaces() {
    let scratch = Scratch::new("texture");
    // Red above blue.
    let image = image::RgbImage::from_raw(1, 2, vec![255, 0, 0, 0, 0, 255]).expect("two pixels");
    image.save(scratch.0.join("flag.png")).expect("a file for the test");
    scratch.file("paint.mtl", "newmtl flag\nKd 1 0.5 1\nmap_Kd flag.png\n");
    let text = "mtllib paint.mtl\nusemtl flag\nv 0 0 0\nv 4 0 0\nv 0 4 0\nvt 0 0\nvt 4 0\nvt 0 4\nf 1/1 2/2 3/3\n";
    let path = scratch.file("flag.obj", text);
    let scene = load_scene(&path).expect("a scene");
    let places: Vec<[f32; 2]> = scene.vertices.iter().map(|vertex| vertex.uv).collect();
    // v points down in scenes.
    assert_eq!(places, [[0.0, 1.0], [4.0, 1.0], [0.0, -3.0]]);
    assert_eq!(scene.textures.images.len(), 1);
    assert_eq!(
        (scene.textures.images[0].levels, scene.textures.images[0].cutoff),
        (2, 0.0)
    );
    for vertex in &scene.vertices {
        assert_eq!((vertex.texture, vertex.color), (1, [1.0, 0.5, 1.0]));
        // A repetition of 1×2 texels a unit of the file, whose diagonal of 4√2 is 10 here.
        let unit = 10.0 / (4.0 * 2.0f32.sqrt());
        assert!(
            (vertex.density * unit - 2.0f32.sqrt()).abs() < 1.0e-5,
            "{}",
            vertex.density
        );
    }

    // Holes by the brightness of another texture.
    let holes = image::GrayImage::from_raw(1, 2, vec![255, 0]).expect("two pixels");
    holes.save(scratch.0.join("holes.png")).expect("a file for the test");
    scratch.file("paint.mtl", "newmtl flag\nKd 1 1 1\nmap_Kd flag.png\nmap_d holes.png\n");
    let textures = load_scene(&path).expect("a scene").textures;
    assert_eq!(textures.images[0].cutoff, 0.5);
    assert_eq!(textures.texels[..2], [0xff00_00ff, 0x00ff_0000]);

    scratch.file("paint.mtl", "newmtl flag\nKd 1 1 1\nmap_Kd flag.png\n");
    scratch.file("flag.png", "no picture");
    assert!(refusal(&path).contains("flag.png"), "{}", refusal(&path));
    let nowhere = text.replace("vt 0 4", "vt 0 inf");
    let image = image::RgbImage::from_pixel(2, 2, image::Rgb([9; 3]));
    image.save(scratch.0.join("flag.png")).expect("a file for the test");
    let refused = refusal(&scratch.file("flag.obj", nowhere));
    assert!(refused.contains("of its texture"), "{refused}");
}

#[test]
fn a_gltf_keeps_its_transforms_and_colours() {
    let scratch = Scratch::new("gltf");
    let scene = load_scene(&write_triangle(&scratch, |text| text)).expect("a scene");
    assert_eq!(scene.triangles.len(), 1);
    for vertex in &scene.vertices {
        assert_eq!(vertex.color, [0.5, 0.25, 1.0]);
        // Half a turn about y.
        assert!(
            (Vec3::from(vertex.normal) - Vec3::NEG_Z).length() < 1.0e-5,
            "{vertex:?}"
        );
    }
    let left = scene.vertices.iter().filter(|vertex| vertex.position[0] < 0.0).count();
    assert_eq!(left, 1, "the triangle points to -x: {:?}", scene.vertices);
}

#[test]
fn mirrored_nodes_still_face_outwards() {
    let scratch = Scratch::new("mirror");
    let path = write_triangle(&scratch, |text| {
        text.replace(r#""rotation": [0, 1, 0, 0]"#, r#""scale": [-1, 1, 1]"#)
    });
    let scene = load_scene(&path).expect("a scene");
    let [a, b, c] = scene.triangles[0].map(|i| Vec3::from(scene.vertices[i as usize].position));
    let face = (b - a).cross(c - a);
    assert!(face.dot(scene.vertices[0].normal.into()) > 0.0);
}

#[test]
fn files_that_are_not_there_or_not_known() {
    let scratch = Scratch::new("missing");
    let message = refusal(&scratch.0.join("none.glb"));
    assert!(
        message.contains("none.glb") && message.contains("cannot be read"),
        "{message}"
    );
    let message = refusal(Path::new("model.fbx"));
    assert!(
        message.contains("model.fbx") && message.contains(".gltf, .glb, .obj"),
        "{message}"
    );
    let path = scratch.file("lone.obj", format!("mtllib absent.mtl\n{QUAD}"));
    assert!(refusal(&path).contains("absent.mtl"), "{}", refusal(&path));
    let path = write_triangle(&scratch, |text| text.replace("data.bin", "absent.bin"));
    assert!(refusal(&path).contains("triangle.gltf"), "{}", refusal(&path));
    let path = write_triangle(&scratch, |text| text.replace("data.bin", "%ff.bin"));
    assert!(refusal(&path).contains("%ff.bin"), "{}", refusal(&path));
}

#[test]
fn broken_obj_files() {
    let scratch = Scratch::new("broken-obj");
    let cases = [
        ("v 0 0 zero\n", "line 1"),
        ("v 0 0 0\nv 1 0 0\nf 1 2 9\n", "out of bounds"),
        ("v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "nowhere"),
        ("v 0 0 0\nv 1 0 0\nl 1 2\n", "no triangles"),
        ("v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n", "no triangles"),
        ("", "no triangles"),
        ("\u{fffd}\u{0} not a model", "no triangles"),
    ];
    for (text, wanted) in cases {
        let path = scratch.file("broken.obj", text);
        let message = refusal(&path);
        assert!(
            message.contains("broken.obj") && message.contains(wanted),
            "{text:?}: {message}"
        );
    }
}

#[test]
fn broken_gltf_files() {
    let scratch = Scratch::new("broken-gltf");
    let cases = [
        (r#""byteLength": 44"#, r#""byteLength": 4400"#, "4400"),
        (
            r#""count": 3, "type": "VEC3""#,
            r#""count": 9, "type": "VEC3""#,
            "beyond",
        ),
        (
            r#""count": 3, "type": "VEC3""#,
            r#""count": 0, "type": "VEC3""#,
            "empty",
        ),
        (
            r#""count": 3, "type": "VEC3""#,
            r#""count": 18446744073709551615, "type": "VEC3""#,
            "beyond",
        ),
        (
            r#""count": 3, "type": "VEC3""#,
            r#""count": 3, "type": "VEC2""#,
            "2 numbers",
        ),
        (
            r#""byteOffset": 36, "byteLength": 6"#,
            r#""byteOffset": 12, "byteLength": 6"#,
            "corners",
        ),
        (
            r#""byteOffset": 0, "byteLength": 36"#,
            r#""byteOffset": 99, "byteLength": 36"#,
            "beyond",
        ),
        (r#""componentType": 5123"#, r#""componentType": 5126"#, "beyond"),
        (r#""mesh": 0"#, r#""mesh": 7"#, "invalid"),
        (r#""indices": 1"#, r#""indices": 1, "mode": 1"#, "no triangles"),
        (
            r#"{"name": "leaf"}"#,
            r#"{"name": "leaf", "children": [0]}"#,
            "ancestor",
        ),
        (r#""POSITION": 0"#, r#""NORMAL": 0"#, "POSITION"),
        (r#""POSITION": 0"#, r#""POSITION": 9"#, "accessor 9"),
        (r#""nodes": [{"#, r#""images": [{}], "nodes": [{"#, "image 0"),
        (
            r#"{"version": "2.0"}"#,
            r#"{"version": "2.0"}, "extensionsRequired": ["KHR_draco"]"#,
            "extension",
        ),
        ("}", "", "triangle.gltf"),
    ];
    for (from, to, wanted) in cases {
        let path = write_triangle(&scratch, |text| text.replacen(from, to, 1));
        let message = refusal(&path);
        assert!(
            message.contains("triangle.gltf") && message.contains(wanted),
            "{to}: {message}"
        );
    }
}

#[test]
fn truncated_files_are_refused_at_any_length() {
    let scratch = Scratch::new("truncated");
    let whole = fs::read(write_triangle(&scratch, |text| text)).expect("the file just written");
    // The last byte is the closing brace.
    for length in 0..whole.len() {
        let path = scratch.file("short.gltf", &whole[..length]);
        assert!(refusal(&path).contains("short.gltf"));
    }
}

#[test]
fn short_colours_and_vast_faces_are_refused() {
    let scratch = Scratch::new("vast");
    scratch.file("paint.mtl", "newmtl red\nKd 0.8\n");
    let said = refusal(&scratch.file("short.obj", format!("mtllib paint.mtl\n{QUAD}")));
    assert!(
        said.contains("line 2: `Kd` takes three numbers, and there are 1"),
        "{said}"
    );
    let corners: String = (0..70_000).map(|k| format!(" {}", k % 4 + 1)).collect();
    let said = refusal(&scratch.file("vast.obj", format!("{QUAD}f{corners}\n")));
    assert!(
        said.contains("line 6: a face has 70000 corners, and at most 65536"),
        "{said}"
    );
    let said = refusal(&scratch.file("far.obj", format!("{QUAD}f 1 2/-9223372036854775807 3\n")));
    assert!(said.contains("line 6") && said.contains("digits"), "{said}");
}

#[test]
#[cfg(unix)]
fn only_regular_files_are_read() {
    let scratch = Scratch::new("devices");
    let refused = |path: &Path| {
        let said = refusal(path);
        assert!(said.contains("only regular files are read"), "{said}");
    };
    let pipe = scratch.0.join("pipe.obj");
    assert!(
        std::process::Command::new("mkfifo")
            .arg(&pipe)
            .status()
            .unwrap()
            .success()
    );
    refused(&pipe);
    refused(&scratch.file("lib.obj", format!("mtllib /dev/zero\n{QUAD}")));
    for uri in ["/dev/zero", "pipe.obj", "file:///dev/zero"] {
        refused(&write_triangle(&scratch, |text| text.replace("data.bin", uri)));
    }
}

//! glTF 2.0, as text or binary.

use super::accessor::{read_floats, read_indices};
use super::assemble::{MeshPart, Normals, Paint};
use super::parse::{parse, unescape_uri};
use super::texture::{HALF, Library, decode_image};
use super::{MAX_BYTES, MAX_TRIANGLES, read_file};
use crate::scene::{Image, SceneError, Textures};
use glam::{Mat3, Mat4, Vec2, Vec3};
use gltf::buffer::Data;
use gltf::material::AlphaMode;
use gltf::mesh::{Mode, Primitive};
use gltf::{Document, Semantic};
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use straightline_files::{self as files, shorten};

/// Every mesh of the default scene, in world space, and its textures.
pub(super) fn read_gltf(path: &Path) -> Result<(Vec<MeshPart>, Textures), SceneError> {
    let bytes = read_file(path)?;
    let parts = || {
        let (document, blob) = parse(&bytes)?;
        let buffers = read_buffers(&document, path.parent(), blob)?;
        let model = Model {
            base: path.parent(),
            buffers: &buffers,
            document: &document,
        };
        model.read_parts()
    };
    parts().map_err(|problem| SceneError::Malformed {
        path: path.to_owned(),
        problem,
    })
}

/// The bytes of every buffer, padded to whole words.
fn read_buffers(document: &Document, base: Option<&Path>, mut blob: Option<Vec<u8>>) -> Result<Vec<Data>, String> {
    let mut all = Vec::new();
    for buffer in document.buffers() {
        let index = buffer.index();
        let mut bytes = match buffer.source() {
            gltf::buffer::Source::Bin => blob
                .take()
                .ok_or_else(|| format!("buffer {index} is in no binary chunk"))?,
            gltf::buffer::Source::Uri(uri) => {
                read_resource(uri, base).map_err(|problem| format!("buffer {index}: {problem}"))?
            }
        };
        bytes.resize(bytes.len().next_multiple_of(4), 0);
        if bytes.len() < buffer.length() {
            let (found, wanted) = (bytes.len(), buffer.length());
            return Err(format!(
                "buffer {index} has {found} bytes, not the {wanted} that it should have"
            ));
        }
        all.push(Data(bytes));
    }
    Ok(all)
}

/// Reads the contents of a URI: data in itself, or a file beside the model.
fn read_resource(uri: &str, base: Option<&Path>) -> Result<Vec<u8>, String> {
    let shown = || shorten(uri);
    let path = match uri.split_once(':') {
        // The crate decodes what needs no file.
        Some(("data", _)) => {
            let data = Data::from_source(gltf::buffer::Source::Uri(uri), base);
            return data
                .map(|data| data.0)
                .map_err(|error| format!("`{}`: {error}", shown()));
        }
        Some(("file", path)) => PathBuf::from(path.strip_prefix("//").unwrap_or(path)),
        Some(_) => return Err(format!("`{}` is neither a file nor data", shown())),
        None => {
            let name = String::from_utf8(unescape_uri(uri)).map_err(|_| format!("`{}` is no text", shown()))?;
            base.unwrap_or(Path::new("")).join(name)
        }
    };
    files::read_file(&path, MAX_BYTES).map_err(|error| format!("`{}`: {error}", shown()))
}

struct Model<'a> {
    base: Option<&'a Path>,
    buffers: &'a [Data],
    document: &'a Document,
}

impl Model<'_> {
    fn read_parts(&self) -> Result<(Vec<MeshPart>, Textures), String> {
        let scene = self.document.default_scene().or_else(|| self.document.scenes().next());
        let scene = scene.ok_or("it has no scene")?;
        let mut parts = Vec::new();
        let mut library = Library::new();
        let mut triangles = 0;
        // A list rather than recursion: a file may nest its nodes as deeply, or in as vicious circles, as it likes.
        let mut seen = HashSet::new();
        let mut ahead: Vec<(gltf::Node, Mat4)> = scene.nodes().map(|node| (node, Mat4::IDENTITY)).collect();
        while let Some((node, outer)) = ahead.pop() {
            if !seen.insert(node.index()) {
                return Err(format!("node {} has two parents, or is its own ancestor", node.index()));
            }
            let place = outer * Mat4::from_cols_array_2d(&node.transform().matrix());
            for primitive in node.mesh().iter().flat_map(|mesh| mesh.primitives()) {
                let mesh = node.mesh().map_or(0, |mesh| mesh.index());
                let name = format!("mesh {mesh}, primitive {}", primitive.index());
                let part = self.read_part(&name, &primitive, place, &mut library);
                let part = part.map_err(|problem| format!("{name}: {problem}"))?;
                triangles += part.triangles.len();
                if triangles > MAX_TRIANGLES {
                    return Err(format!("there are more than {MAX_TRIANGLES} triangles"));
                }
                parts.push(part);
            }
            ahead.extend(node.children().map(|child| (child, place)));
        }
        Ok((parts, library.finish()))
    }

    fn read_part(
        &self,
        name: &str,
        primitive: &Primitive,
        place: Mat4,
        library: &mut Library<usize>,
    ) -> Result<MeshPart, String> {
        let positions = primitive.get(&Semantic::Positions).ok_or("it has no positions")?;
        let positions = vectors(&read_floats::<3>(&positions, self.buffers)?);
        let normals = match primitive.get(&Semantic::Normals) {
            Some(normals) => {
                // Normals stay at right angles to surfaces, whatever the scale along each axis.
                let rotate = cofactor(Mat3::from_mat4(place));
                let normals = vectors(&read_floats::<3>(&normals, self.buffers)?);
                Normals::Given(normals.into_iter().map(|normal| rotate * normal).collect())
            }
            None => Normals::Flat,
        };
        let corners = match primitive.indices() {
            Some(accessor) => read_indices(&accessor, self.buffers)?,
            None => (0..positions.len() as u32).collect(),
        };
        Ok(MeshPart {
            name: name.to_owned(),
            colors: self.vertex_colors(primitive, positions.len())?,
            paint: self.read_paint(primitive, library)?,
            positions: positions
                .into_iter()
                .map(|position| place.transform_point3(position))
                .collect(),
            normals,
            triangles: primitive_triangles(primitive.mode(), &corners),
        })
    }

    /// Linear colour of each of `count` vertices.
    fn vertex_colors(&self, primitive: &Primitive, count: usize) -> Result<Vec<Vec3>, String> {
        let material = primitive.material().pbr_metallic_roughness();
        let [r, g, b, _] = material.base_color_factor();
        let mut colors = vec![Vec3::new(r, g, b); count];
        let mut tint = |tints: Vec<Vec3>| match tints.len() == count {
            true => {
                colors.iter_mut().zip(tints).for_each(|(color, tint)| *color *= tint);
                Ok(())
            }
            false => Err(format!("{} colours for {count} vertices", tints.len())),
        };
        if let Some(accessor) = primitive.get(&Semantic::Colors(0)) {
            tint(match accessor.dimensions() {
                gltf::accessor::Dimensions::Vec4 => read_floats::<4>(&accessor, self.buffers)?
                    .into_iter()
                    .map(|[r, g, b, _]| Vec3::new(r, g, b))
                    .collect(),
                _ => vectors(&read_floats::<3>(&accessor, self.buffers)?),
            })?;
        }
        Ok(colors)
    }

    /// The base colour texture, if there is one, and holes where the material has them.
    fn read_paint(&self, primitive: &Primitive, library: &mut Library<usize>) -> Result<Option<Paint>, String> {
        let material = primitive.material();
        let base = material.pbr_metallic_roughness();
        let Some(info) = base.base_color_texture() else {
            return Ok(None);
        };
        let Some(accessor) = primitive.get(&Semantic::TexCoords(info.tex_coord())) else {
            return Ok(None);
        };
        let source = info.texture().source();
        let image = match library.get(&source.index()) {
            Some(image) => image,
            None => self
                .read_image(&source)
                .and_then(|picture| library.add(source.index(), &picture, 0.0))
                .map_err(|problem| format!("image {}: {problem}", source.index()))?,
        };
        // Blended surfaces are there or not: nothing is drawn through anything.
        let of_texture = |cutoff: f32| cutoff / base.base_color_factor()[3].max(1.0e-6);
        let cutoff = match material.alpha_mode() {
            AlphaMode::Opaque => 0.0,
            AlphaMode::Mask => of_texture(material.alpha_cutoff().unwrap_or(HALF)),
            AlphaMode::Blend => of_texture(HALF),
        };
        let uvs = read_floats::<2>(&accessor, self.buffers)?.into_iter().map(Vec2::from);
        Ok(Some(library.add_paint(Image { cutoff, ..image }, uvs.collect())))
    }

    fn read_image(&self, image: &gltf::Image) -> Result<image::RgbaImage, String> {
        let bytes = match image.source() {
            gltf::image::Source::View { view, .. } => {
                let bytes = self.buffers.get(view.buffer().index()).and_then(|buffer| {
                    let end = view.offset().checked_add(view.length())?;
                    buffer.get(view.offset()..end)
                });
                bytes.ok_or("reaches beyond its buffer")?.to_vec()
            }
            gltf::image::Source::Uri { uri, .. } => read_resource(uri, self.base)?,
        };
        decode_image(&bytes)
    }
}

fn vectors(arrays: &[[f32; 3]]) -> Vec<Vec3> {
    arrays.iter().copied().map(Vec3::from).collect()
}

/// The inverse transpose times the determinant's magnitude: turns normals, and unlike it there is one even for
/// flattened things.
fn cofactor(matrix: Mat3) -> Mat3 {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let turned = Mat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
    if matrix.determinant() < 0.0 { -turned } else { turned }
}

/// Triangles of a primitive with these corners; none of points and lines.
fn primitive_triangles(mode: Mode, corners: &[u32]) -> Vec<[u32; 3]> {
    match mode {
        Mode::Triangles => corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(),
        Mode::TriangleStrip => {
            let triples = corners.windows(3).enumerate();
            triples
                .map(|(i, c)| {
                    if i % 2 == 0 {
                        [c[0], c[1], c[2]]
                    } else {
                        [c[1], c[0], c[2]]
                    }
                })
                .collect()
        }
        Mode::TriangleFan => {
            let edges = corners.get(1..).unwrap_or_default().windows(2);
            edges.map(|edge| [corners[0], edge[0], edge[1]]).collect()
        }
        Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => Vec::new(),
    }
}

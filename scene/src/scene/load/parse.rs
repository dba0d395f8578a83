//! From the bytes of a glTF file to a document that can be walked.

use gltf::json::{Root, validation::Checked};
use gltf::{Document, Gltf, Semantic};
use straightline_files::shorten;

/// The document, validated, and the binary chunk if there is one.
pub(super) fn parse(bytes: &[u8]) -> Result<(Document, Option<Vec<u8>>), String> {
    let Gltf { document, blob } = Gltf::from_slice_without_validation(bytes).map_err(|error| match is_first(bytes) {
        true => "this is glTF 1.0, and only glTF 2.0 is read: convert it, for instance with `gltf-pipeline -i old.gltf -o new.glb`"
            .to_owned(),
        false => error.to_string(),
    })?;
    let json = document.into_json();
    check_document(&json)?;
    let document = Document::from_json(json).map_err(|error| error.to_string())?;
    Ok((document, blob))
}

/// Returns whether a file that cannot be read is glTF 1.0: by its header or its own word, or by its meshes, which have names
/// there and numbers from 2.0 on.
fn is_first(bytes: &[u8]) -> bool {
    if let Some(version) = bytes.strip_prefix(b"glTF") {
        return version.starts_with(&1u32.to_le_bytes());
    }
    let Ok(json) = serde_json::from_slice::<serde_json::Value>(bytes) else {
        return false;
    };
    match json.pointer("/asset/version") {
        Some(serde_json::Value::String(version)) => version == "1" || version.starts_with("1."),
        Some(serde_json::Value::Number(version)) => version.as_f64().is_some_and(|version| version < 2.0),
        _ => json.get("meshes").is_some_and(serde_json::Value::is_object),
    }
}

/// Refuses what the `gltf` crate would panic on, in its validation or later: positions and images that are nowhere,
/// and names that are no text.
fn check_document(json: &Root) -> Result<(), String> {
    let accessors = json.accessors.len();
    for (at, primitive) in json.meshes.iter().flat_map(|mesh| &mesh.primitives).enumerate() {
        let positions = primitive.attributes.get(&Checked::Valid(Semantic::Positions));
        if let Some(index) = positions.filter(|index| index.value() >= accessors) {
            let index = index.value();
            return Err(format!(
                "primitive {at} has its positions in accessor {index}, and there are {accessors}"
            ));
        }
    }
    for (at, image) in json.images.iter().enumerate() {
        if image.buffer_view.is_some() && image.mime_type.is_none() {
            return Err(format!("image {at} is in a buffer and has no MIME type"));
        }
        if image.buffer_view.is_none() && image.uri.is_none() {
            return Err(format!("image {at} is nowhere: it has neither a buffer view nor a URI"));
        }
    }
    let buffers = json.buffers.iter().filter_map(|buffer| buffer.uri.as_ref());
    let images = json.images.iter().filter_map(|image| image.uri.as_ref());
    match buffers.chain(images).find(|uri| !is_text(uri)) {
        Some(uri) => Err(format!("the URI `{}` does not stand for UTF-8 text", shorten(uri))),
        None => Ok(()),
    }
}

/// Returns whether `uri` is text once its percent escapes are resolved.
fn is_text(uri: &str) -> bool {
    String::from_utf8(unescape_uri(uri)).is_ok()
}

/// The bytes of `uri` with its percent escapes resolved.
pub(super) fn unescape_uri(uri: &str) -> Vec<u8> {
    let bytes = uri.as_bytes();
    let mut decoded = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while at < bytes.len() {
        let digits = uri.get(at + 1..at + 3).filter(|_| bytes[at] == b'%');
        match digits.and_then(|digits| u8::from_str_radix(digits, 16).ok()) {
            Some(byte) => {
                decoded.push(byte);
                at += 3;
            }
            None => {
                decoded.push(bytes[at]);
                at += 1;
            }
        }
    }
    decoded
}

//! Outputs of a shader.

use crate::{Access, Format, Scalar, ValueType, ViewDimension};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Serialize, Serializer};
use std::fmt;

/// Target of a result: a storage texture of a compute shader, a colour of a fragment shader, the return value of a function.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Output {
    /// Name in the shader: `destination`, or that of a field of the structure that the kernel returns.
    pub name: String,
    /// Bind group; compute only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub group: Option<u32>,
    /// Binding number of the write-only storage texture; compute only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub binding: Option<u32>,
    /// Colour attachment location; fragment only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub location: Option<u32>,
    /// Always `write-only`.
    pub access: Access,
    /// Dimension of the view that is written: always `2d`.
    pub view_dimension: ViewDimension,
    /// Texel format of the storage texture. A fragment shader writes to a colour target of any format with components of the
    /// same kind and no more of them, and this is the one it was generated for.
    pub format: Format,
    /// Type of the value, a number or a vector. Components of the texel that it lacks are 0, and the fourth is 1.
    #[serde(rename = "type", default = "colour", skip_serializing_if = "is_colour")]
    pub ty: ValueType,
    /// Width and height of the texels that a workgroup writes, of an output with a size of its own: a dispatch has as many
    /// workgroups as the output that needs most of them. Without it, all outputs have one size, and each invocation writes
    /// its block of their texels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tile: Option<[u32; 2]>,
}

fn colour() -> ValueType {
    ValueType::of(Scalar::F32, 4)
}

fn is_colour(ty: &ValueType) -> bool {
    *ty == colour()
}

/// Writes one output as itself, and any other number of them as a list.
pub(crate) fn serialize<S: Serializer>(outputs: &[Output], to: S) -> Result<S::Ok, S::Error> {
    match outputs {
        [one] => one.serialize(to),
        several => several.serialize(to),
    }
}

/// Deserializes the output of [`serialize`].
pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Output>, D::Error> {
    struct OneOrSeveral;
    impl<'de> Visitor<'de> for OneOrSeveral {
        type Value = Vec<Output>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("an output or a list of outputs")
        }

        fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Vec<Output>, A::Error> {
            Output::deserialize(MapAccessDeserializer::new(map)).map(|output| vec![output])
        }

        fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Vec<Output>, A::Error> {
            Vec::deserialize(SeqAccessDeserializer::new(list))
        }
    }
    from.deserialize_any(OneOrSeveral)
}

//! Knobs by name, with values as texts: settings from an engine, a message or a command line.

use super::{Arity, Knob, ShaderSpec};
use serde::de::{Error, MapAccess, SeqAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;

/// Values for some knobs of a shader, by their names. Each value has been validated.
///
/// As JSON or TOML an object: `{ "unroll": "none", "region": true, "set": { "pattern": "latin16" }, "target": ["wgsl",
/// "hlsl"] }`.
#[derive(Clone, Debug, Default)]
pub struct Overrides(Vec<(&'static Knob, Vec<String>)>);

impl Overrides {
    /// Returns the knobs of a description that differ from their defaults.
    pub fn of_changed(spec: &ShaderSpec) -> Overrides {
        let unset = ShaderSpec::new();
        let changed = super::KNOBS.iter().filter_map(|knob| {
            let texts = knob.value_texts(spec);
            (texts != knob.value_texts(&unset)).then_some((knob, texts))
        });
        Overrides(changed.collect())
    }

    /// Sets a knob, replacing any previous value.
    ///
    /// # Errors
    ///
    /// If there is no such knob, or the texts are not a valid value.
    pub fn set(&mut self, name: &str, texts: Vec<String>) -> Result<(), String> {
        let knob = Knob::find(name)?;
        let borrowed: Vec<&str> = texts.iter().map(String::as_str).collect();
        knob.set(&mut ShaderSpec::new(), &borrowed)?;
        self.0.retain(|(known, _)| known.name != knob.name);
        self.0.push((knob, texts));
        Ok(())
    }

    /// Returns whether a knob is set.
    pub fn has(&self, name: &str) -> bool {
        self.0.iter().any(|(knob, _)| knob.name == name)
    }

    /// Returns the names of the set knobs, in order.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        self.0.iter().map(|(knob, _)| knob.name)
    }

    /// Returns the description with these values applied.
    pub fn apply(&self, mut spec: ShaderSpec) -> ShaderSpec {
        for (knob, texts) in &self.0 {
            let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
            // `set` has parsed the same texts before.
            let read = knob.set(&mut spec, &texts);
            debug_assert_eq!(read, Ok(()), "{}", knob.name);
        }
        spec
    }
}

impl Serialize for Overrides {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (knob, texts) in &self.0 {
            match (knob.arity, texts.as_slice()) {
                (Arity::Flag, [text]) => map.serialize_entry(knob.name, &(text == "true"))?,
                (Arity::One, [text]) => map.serialize_entry(knob.name, text)?,
                _ => map.serialize_entry(knob.name, texts)?,
            }
        }
        map.end()
    }
}

impl<'de> Deserialize<'de> for Overrides {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Knobs;
        impl<'de> Visitor<'de> for Knobs {
            type Value = Overrides;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("settings of a shader by name")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Overrides, A::Error> {
                let mut overrides = Overrides::default();
                while let Some(name) = map.next_key::<String>()? {
                    let Texts(texts) = map.next_value()?;
                    Knob::find(&name).map_err(A::Error::custom)?;
                    let set = overrides.set(&name, texts);
                    set.map_err(|why| A::Error::custom(format!("`{name}`: {why}")))?;
                }
                Ok(overrides)
            }
        }
        deserializer.deserialize_map(Knobs)
    }
}

impl Serialize for ShaderSpec {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Overrides::of_changed(self).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for ShaderSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ok(Overrides::deserialize(deserializer)?.apply(ShaderSpec::new()))
    }
}

/// Texts of a value: the text, number or boolean itself, the elements of a list, or `NAME=VALUE` for an object.
struct Texts(Vec<String>);

impl<'de> Deserialize<'de> for Texts {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Values;
        impl<'de> Visitor<'de> for Values {
            type Value = Texts;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a text, a number, `true` or `false`, a list of them, or an object with them")
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<Texts, E> {
                Ok(Texts(vec![text.to_owned()]))
            }

            fn visit_bool<E: Error>(self, value: bool) -> Result<Texts, E> {
                Ok(Texts(vec![value.to_string()]))
            }

            fn visit_u64<E: Error>(self, number: u64) -> Result<Texts, E> {
                Ok(Texts(vec![number.to_string()]))
            }

            fn visit_i64<E: Error>(self, number: i64) -> Result<Texts, E> {
                Ok(Texts(vec![number.to_string()]))
            }

            fn visit_f64<E: Error>(self, number: f64) -> Result<Texts, E> {
                Ok(Texts(vec![number.to_string()]))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Texts, A::Error> {
                let mut texts = Vec::new();
                while let Some(Texts(text)) = list.next_element()? {
                    texts.extend(text);
                }
                Ok(Texts(texts))
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Texts, A::Error> {
                let mut texts = Vec::new();
                while let Some((name, Texts(values))) = map.next_entry::<String, Texts>()? {
                    texts.extend(values.iter().map(|value| format!("{name}={value}")));
                }
                Ok(Texts(texts))
            }
        }
        deserializer.deserialize_any(Values)
    }
}

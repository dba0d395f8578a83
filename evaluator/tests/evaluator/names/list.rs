//! Lines of the list: a type, and a name with its signature.

/// Public names of Rust and glam, made by `list.py`.
const LIST: &str = include_str!("../../names/names.txt");

/// Calls that no signature tells how to write.
const CALLS: &str = include_str!("../../names/calls.txt");

/// A method, an associated function or a constant.
pub struct Name {
    /// The type.
    pub of: &'static str,
    pub name: &'static str,
    /// Parameters and result, or the type of a constant.
    pub signature: &'static str,
}

impl Name {
    /// Returns every name of the list.
    pub fn all() -> impl Iterator<Item = Name> {
        LIST.lines().filter(|line| !line.starts_with('#')).map(Name::parse)
    }

    fn parse(line: &'static str) -> Name {
        let (of, declared) = line.split_once(": ").unwrap_or_else(|| panic!("{line}"));
        let rest = declared.strip_prefix("fn ").unwrap_or(declared);
        let end = rest.find(['<', '(', ':']).unwrap_or_else(|| panic!("{line}"));
        Name {
            of,
            name: &rest[..end],
            signature: &rest[end..],
        }
    }

    /// Returns the statement that uses the name in a kernel; `None` if no value is known for a parameter.
    pub fn statement(&self) -> Option<String> {
        if let Some(call) = self.known_call() {
            return Some(format!("{call};"));
        }
        let of = match self.of {
            "Range" | "RangeInclusive" | "Option" | "Result" | "Iterator" | "array" | "slice" | "mem" => return None,
            of => of,
        };
        let Some(signature) = self.signature.strip_prefix('(') else {
            return Some(format!("let made = {of}::{};", self.name));
        };
        let end = closing_parenthesis(signature)?;
        let (parameters, result) = (&signature[..end], &signature[end..]);
        let (mut receiver, mut arguments) = (None, Vec::new());
        for parameter in split_parameters(parameters) {
            match parameter.split_once(": ") {
                Some((_, ty)) => arguments.push(value(of, ty)?),
                None => receiver = Some(parameter),
            }
        }
        let arguments = arguments.join(", ");
        let call = match receiver {
            None => format!("{of}::{}({arguments})", self.name),
            Some("&mut self") => format!("changed.{}({arguments})", self.name),
            Some(_) => format!("{}.{}({arguments})", value(of, of)?, self.name),
        };
        let call = match result.contains("->") {
            true => format!("let made = {call};"),
            false => format!("{call};"),
        };
        Some(match receiver {
            Some("&mut self") => format!("let mut changed = {}; {call}", value(of, of)?),
            _ => call,
        })
    }

    /// Returns the call that is written down for the name.
    fn known_call(&self) -> Option<&'static str> {
        CALLS.lines().find_map(|line| {
            let (name, call) = line.split_once(": ")?;
            let (of, name) = name.split_once(' ')?;
            (of.split('|').any(|of| of == self.of) && name == self.name).then_some(call)
        })
    }
}

/// Returns the place of the parenthesis that closes the parameters.
fn closing_parenthesis(text: &str) -> Option<usize> {
    let mut depth = 0;
    text.char_indices().find_map(|(k, c)| {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        (depth < 0).then_some(k)
    })
}

/// Parameters, split at commas outside of brackets.
fn split_parameters(text: &str) -> Vec<&str> {
    let (mut depth, mut start, mut found) = (0, 0, Vec::new());
    for (k, c) in text.char_indices() {
        match c {
            '(' | '[' | '<' => depth += 1,
            ')' | ']' | '>' => depth -= 1,
            ',' if depth == 0 => {
                found.push(text[start..k].trim());
                start = k + 1;
            }
            _ => {}
        }
    }
    found.push(text[start..].trim());
    found.retain(|parameter| !parameter.is_empty());
    found
}

/// Returns a runtime value of a type, from the parameters of the kernel.
fn value(of: &str, ty: &str) -> Option<String> {
    let ty = if ty == "Self" { of } else { ty };
    let known = match ty {
        "f32" => "f",
        "i32" => "i",
        "u32" => "u",
        "bool" => "b",
        "usize" => "1",
        "Vec2" => "v2",
        "Vec3" => "v3",
        "Vec4" => "v4",
        "IVec2" => "i2",
        "IVec3" => "i3",
        "IVec4" => "i4",
        "UVec2" => "u2",
        "UVec3" => "u3",
        "UVec4" => "u4",
        "BVec2" => "v2.cmplt(Vec2::ONE)",
        "BVec3" => "v3.cmplt(Vec3::ONE)",
        "BVec4" | "BVec4A" => "v4.cmplt(Vec4::ONE)",
        "Mat2" => "m2",
        "Mat3" => "m3",
        "Mat4" => "m4",
        "Quat" => "Quat::from_xyzw(f, 0.25, 0.5, 1.0)",
        "Affine2" => "Affine2::from_cols(v2, v2, v2)",
        "Affine3A" => "Affine3A::from_mat4(m4)",
        "EulerRot" => "EulerRot::XYZ",
        _ => {
            if let Some(element) = ty.strip_prefix("&[").and_then(|ty| ty.strip_suffix(']'))
                && !element.contains(';')
            {
                return Some(format!("&[{0}, {0}, {0}, {0}]", value(of, element)?));
            }
            if let Some(element) = ty.strip_prefix("&mut [").and_then(|ty| ty.strip_suffix(']')) {
                return Some(format!("&mut [{0}, {0}, {0}, {0}]", value(of, element)?));
            }
            if let Some(of_reference) = ty.strip_prefix("&mut ") {
                return Some(format!("&mut {}", value(of, of_reference)?));
            }
            if let Some(of_reference) = ty.strip_prefix('&') {
                return Some(format!("&{}", value(of, of_reference)?));
            }
            if let Some((element, count)) = ty
                .strip_prefix('[')
                .and_then(|ty| ty.strip_suffix(']')?.rsplit_once("; "))
            {
                let count: usize = count.parse().ok()?;
                return Some(format!("[{}]", vec![value(of, element)?; count].join(", ")));
            }
            return None;
        }
    };
    Some(known.to_owned())
}

//! Parameters and result of a kernel, read from its text, and its call in rustc's program.

use std::fmt::Write;

/// The kernel's parameters and what it gives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Interface {
    /// Name and type of each parameter.
    pub params: Vec<(String, String)>,
    /// Type of what it gives, empty if it gives nothing.
    pub result: String,
    /// Names of the fields, if the text has a structure of that type.
    fields: Vec<String>,
}

impl Interface {
    /// Of the function `k` of a text; `None` if there is none.
    pub fn of(source: &str) -> Option<Interface> {
        let from = source.find("pub fn k(")? + "pub fn k(".len();
        let to = from + source[from..].find(')')?;
        let params = source[from..to].split(", ").filter(|param| !param.trim().is_empty());
        let params = together(params).into_iter().map(|param| {
            let (name, ty) = param.split_once(':')?;
            Some((name.trim().to_owned(), ty.trim().trim_end_matches(',').to_owned()))
        });
        let rest = &source[to + 1..];
        let result = rest
            .split('{')
            .next()?
            .trim()
            .trim_start_matches("->")
            .trim()
            .to_owned();
        let each = result
            .strip_prefix("PerThread<")
            .map_or(result.as_str(), |of| of.trim_end_matches('>'));
        let structure = format!("pub struct {each} {{");
        let fields = source.lines().skip_while(|line| *line != structure).skip(1);
        let fields = fields.take_while(|line| *line != "}").filter_map(|line| {
            let (name, _) = line.trim().strip_prefix("pub ")?.split_once(':')?;
            Some(name.to_owned())
        });
        Some(Interface {
            params: params.collect::<Option<_>>()?,
            fields: fields.collect(),
            result,
        })
    }

    /// Buffers and pictures that the kernel writes: the name and the type of each.
    pub fn written(&self) -> impl Iterator<Item = (&str, &str)> {
        let written = self.params.iter().filter(|(_, ty)| is_written(ty));
        written.map(|(name, ty)| (name.as_str(), ty.as_str()))
    }

    /// Rust text, for the module that a text stands in, of a function that calls the kernel for all pixels and prints what it
    /// gives and writes.
    ///
    /// # Errors
    ///
    /// The program has nothing for a parameter.
    pub fn caller(&self) -> Result<String, String> {
        let (mut text, mut args) = (String::new(), Vec::new());
        if !self.fields.is_empty() {
            let each = self.result.trim_start_matches("PerThread<").trim_end_matches('>');
            let parts: String = self.fields.iter().map(|f| format!("self.{f}.texels(out);")).collect();
            let _ = writeln!(
                text,
                "impl super::Given for {each} {{ fn texels(&self, out: &mut Vec<[f64; 4]>) {{ use super::Given; {parts} }} }}"
            );
        }
        text += "pub fn straightline_native(w: &super::World, out: &mut Vec<u8>) {\n";
        let mut group = None;
        for (name, ty) in &self.params {
            if is_written(ty) {
                let _ = writeln!(text, "let {name} = {};", initial(name).ok_or_else(|| unknown(name))?);
            }
            if let Some(size) = ty.strip_prefix("&Workgroup<") {
                group = Some(size.trim_end_matches('>'));
            }
            args.push(argument(name, ty).ok_or_else(|| unknown(name))?);
        }
        let args = args.join(", ");
        let _ = match group {
            Some(size) => writeln!(
                text,
                "super::groups::<{size}>(out, &|group| super::Threads::threads(&k({args})));"
            ),
            None => writeln!(text, "super::pixels(out, &|pixel| super::texels(&k({args})));"),
        };
        for (name, ty) in self.written() {
            let all = if ty.starts_with("&StorageTexture<") {
                "texels"
            } else {
                "elements"
            };
            let _ = writeln!(text, "super::buffer(out, \"{name}\", &{name}.{all}());");
        }
        Ok(text + "}")
    }
}

/// Parts of a list whose brackets close, from those between commas.
fn together<'a>(parts: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut whole: Vec<String> = Vec::new();
    for part in parts {
        let open = |text: &str| text.matches('<').count() > text.matches('>').count();
        match whole.last_mut() {
            Some(last) if open(last) => *last += &format!(", {part}"),
            _ => whole.push(part.to_owned()),
        }
    }
    whole
}

fn unknown(name: &str) -> String {
    format!("no argument for the parameter `{name}`")
}

fn is_written(ty: &str) -> bool {
    let written = ["&StorageBuffer<", "&AtomicBuffer<", "&StorageTexture<"];
    written.iter().any(|prefix| ty.starts_with(prefix))
}

/// Initial contents of a buffer that is written. `World::inputs` has the same.
fn initial(name: &str) -> Option<&'static str> {
    Some(match name {
        "wf" => "StorageBuffer::new((0..32).map(|k| w.c.float(k)).collect())",
        "wv" => "StorageBuffer::new((0..32).map(|k| Vec4::splat(w.c.float(k + 5))).collect())",
        "wi" => "StorageBuffer::new((0..32).map(|k| IVec2::splat(w.c.bit(k) as i32)).collect())",
        "wt" => "StorageTexture::new(uvec2(super::SIZE[0], super::SIZE[1]))",
        "xu" => "AtomicBuffer::new((0..42).map(|k| w.c.bit(k)).collect())",
        "xi" => "AtomicBuffer::new((0..42).map(|k| w.c.bit(k + 3) as i32).collect())",
        _ => return None,
    })
}

/// The program's argument for a parameter.
fn argument(name: &str, ty: &str) -> Option<String> {
    Some(match (name, ty) {
        ("cfg", _) => "&Default::default()".to_owned(),
        ("a" | "b", _) => format!("&w.{name}"),
        ("p", _) => "super::P".to_owned(),
        ("q", _) => "super::Q".to_owned(),
        ("r", _) => "super::R".to_owned(),
        ("pixel" | "group", _) => name.to_owned(),
        ("resolution", _) => "uvec2(super::SIZE[0], super::SIZE[1])".to_owned(),
        ("un", _) => "vec3(w.c.float(50), w.c.float(51), w.c.float(52))".to_owned(),
        ("um", _) => "Mat3::from_cols_array(&std::array::from_fn(|k| w.c.float(k + 40)))".to_owned(),
        ("ua", _) => "&std::array::from_fn(|k| vec2(w.c.float(k + 20), w.c.float(k + 27)))".to_owned(),
        ("ui", _) => "std::array::from_fn(|k| w.c.bit(k + 30) as i32)".to_owned(),
        ("up", _) => format!("&[{}, {}]", part(2), part(8)),
        ("bs", _) => {
            let turn = "Mat2::from_cols_array(&std::array::from_fn(|n| w.c.float(k + n)))";
            let tints = "std::array::from_fn(|n| vec3(w.c.float(k + n), w.c.float(k + 3), w.c.float(7 * n)))";
            format!(
                "&Buffer::new((0..3).map(|k| Rec {{ place: vec3(w.c.float(k), w.c.float(k + 1), w.c.float(k + 2)), \
                 kind: w.c.bit(k), part: {}, turn: {turn}, tints: {tints} }}).collect())",
                part(0).replace("float(", "float(k + ")
            )
        }
        ("scene", _) => {
            "&Scene { shade: &w.c.ff, table: &w.c.bi, tint: vec3(w.c.float(3), w.c.float(6), w.c.float(9)), \
                         steps: std::array::from_fn(|k| w.c.bit(k + 11)) }"
                .to_owned()
        }
        (_, ty) if is_written(ty) => format!("&{name}"),
        (_, ty) if ty.starts_with("&Shared<") => "&Shared::new()".to_owned(),
        (_, ty) if ty.starts_with("&AtomicShared<") => "&AtomicShared::new()".to_owned(),
        _ if name.len() > 3 || !RESOURCES.contains(&name) => return None,
        _ => format!("&w.c.{name}"),
    })
}

/// A `Part`, of the numbers from one on.
fn part(from: usize) -> String {
    let numbers: Vec<String> = (from + 1..from + 4).map(|k| format!("w.c.float({k})")).collect();
    format!("Part {{ scale: w.c.float({from}), powers: [{}] }}", numbers.join(", "))
}

/// The fields of `Resources`.
const RESOURCES: &[&str] = &[
    "bu", "bi", "bv", "bw", "fu", "fi", "ff", "fv", "fw", "fl", "tm", "ti", "ta", "tv", "tc", "ts", "td", "tda", "tdc",
    "s", "sc",
];

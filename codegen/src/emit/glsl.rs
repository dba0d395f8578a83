//! GLSL 4.50 for Vulkan, with separate textures.

use super::dialect::{Dialect, Division, float, integer, operator};
use super::resources::Resources;
use super::text::{Binds, Text};
use crate::ir::{Axis, BinaryOp, Direction, Scalar, TextureKind, Type, UnaryOp};

/// What follows a buffer's name to ask for its length.
pub const LENGTH: &str = ".elements.length()";

/// The four texels around a place, or what a comparison gives of them.
pub const GATHER: &str = "textureGather";

/// Quad operations, horizontal, vertical and diagonal.
pub const MESSAGES: [&str; 3] = [
    "subgroupQuadSwapHorizontal",
    "subgroupQuadSwapVertical",
    "subgroupQuadSwapDiagonal",
];

/// The smallest `int`, which no literal is.
const SMALLEST: &str = "(-2147483647 - 1)";

/// A name or a number.
fn is_leaf(code: &str) -> bool {
    let number = code.trim_start_matches('-').starts_with(|c: char| c.is_ascii_digit());
    number || code.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// A leaf, or an operator between two of them.
fn is_simple(x: &Text) -> bool {
    x.size <= 1 && x.code.split(' ').step_by(2).all(is_leaf)
}

/// GLSL 4.50.
pub struct Glsl<'a> {
    /// The shader's bindings.
    pub resources: &'a Resources,
}

impl Glsl<'_> {
    /// A texture with the sampler that filters nothing.
    fn unfiltered(&self, texture: u32) -> Text {
        let texture = self.resources.texture(texture);
        let kind = super::shell::glsl_sampler(texture.kind);
        Text::name(format!("{kind}({}, {})", texture.name, super::resources::SAMPLER))
    }

    /// A texture with a sampler of the kernel's.
    fn through(&self, kind: &str, texture: u32, sampler: u32) -> Text {
        let texture = &self.resources.texture(texture).name;
        Text::name(format!("{kind}({texture}, {})", self.resources.sampler(sampler).name))
    }
}

impl Dialect for Glsl<'_> {
    fn name(&self) -> &'static str {
        "glsl450"
    }

    fn ty(&self, ty: Type) -> String {
        match ty {
            Type::Value { scalar, lanes: 1 } => match scalar {
                Scalar::F32 => "float",
                Scalar::I32 => "int",
                Scalar::U32 => "uint",
                Scalar::Bool => "bool",
            }
            .to_owned(),
            Type::Value { scalar, lanes } => {
                let kind = match scalar {
                    Scalar::F32 => "",
                    Scalar::I32 => "i",
                    Scalar::U32 => "u",
                    Scalar::Bool => "b",
                };
                format!("{kind}vec{lanes}")
            }
            Type::Array { len, .. } => format!("{}[{len}]", self.ty(ty.element())),
            Type::Results => "void".to_owned(),
        }
    }

    fn scalar(&self, kind: Scalar, bits: u32) -> Text {
        match kind {
            Scalar::F32 => float(bits),
            Scalar::I32 if bits as i32 == i32::MIN => Text::name(SMALLEST),
            Scalar::I32 => integer(i64::from(bits as i32), ""),
            Scalar::U32 => integer(i64::from(bits), "u"),
            Scalar::Bool => Text::name(if bits != 0 { "true" } else { "false" }),
        }
    }

    fn immutable(&self, name: &str, ty: Type, value: &str) -> String {
        self.mutable(name, ty, Some(value))
    }

    fn mutable(&self, name: &str, ty: Type, value: Option<&str>) -> String {
        let element = self.ty(ty.element());
        let extent = match ty {
            Type::Array { len, .. } => format!("[{len}]"),
            _ => String::new(),
        };
        match value {
            Some(value) => format!("{element} {name}{extent} = {value};"),
            None => format!("{element} {name}{extent};"),
        }
    }

    fn table(&self, name: &str, ty: Type, value: &str) -> String {
        format!("const {}", self.mutable(name, ty, Some(value)))
    }

    fn loop_head(&self, counter: &str, ty: Type, start: &Text, end: &Text) -> String {
        format!(
            "for ({} {counter} = {}; {}; {counter}++) {{",
            if ty == Type::U32 { "uint" } else { "int" },
            start.code,
            Text::infix(&Text::name(counter), "<", end, Binds::Comparison).code
        )
    }

    fn if_head(&self, condition: &Text) -> String {
        format!("if ({}) {{", condition.code)
    }

    fn load(&self, texture: u32, coord: &Text, layer: Option<&Text>) -> Text {
        let entry = self.resources.texture(texture);
        let name = self.unfiltered(texture);
        let texel = match (layer, entry.kind) {
            (Some(sample), TextureKind::Multisampled) => Text::call("texelFetch", &[&name, coord, sample]),
            (Some(layer), _) => {
                let coord = Text::call("ivec3", &[coord, layer]);
                Text::call("texelFetch", &[&name, &coord, &Text::name("0")])
            }
            (None, _) => Text::call("texelFetch", &[&name, coord, &Text::name("0")]),
        };
        match entry.components {
            4 => texel,
            n => Text::member(&texel, &"xyzw"[..n as usize]),
        }
    }

    fn sample(&self, texture: u32, sampler: u32, uv: &Text) -> Text {
        let through = self.through("sampler2D", texture, sampler);
        let texel = Text::call("textureLod", &[&through, uv, &Text::name("0.0")]);
        match self.resources.texture(texture).components {
            4 => texel,
            n => Text::member(&texel, &"xyzw"[..n as usize]),
        }
    }

    fn gather(&self, texture: u32, sampler: u32, component: u8, uv: &Text) -> Text {
        let through = self.through("sampler2D", texture, sampler);
        let component = Text::name(component.to_string());
        Text::call(GATHER, &[&through, uv, &component])
    }

    fn compare(&self, texture: u32, sampler: u32, uv: &Text, reference: &Text) -> Text {
        let through = self.through("sampler2DShadow", texture, sampler);
        let place = Text::call("vec3", &[uv, reference]);
        Text::call("textureLod", &[&through, &place, &Text::name("0.0")])
    }

    fn gather_compare(&self, texture: u32, sampler: u32, uv: &Text, reference: &Text) -> Text {
        let through = self.through("sampler2DShadow", texture, sampler);
        Text::call(GATHER, &[&through, uv, reference])
    }

    fn message(&self, direction: Direction, x: &Text) -> Text {
        let function = match direction {
            Direction::Horizontal => MESSAGES[0],
            Direction::Vertical => MESSAGES[1],
            Direction::Diagonal => MESSAGES[2],
        };
        Text::call(function, &[x])
    }

    fn derivative(&self, axis: Axis, x: &Text) -> Text {
        Text::call(if axis == Axis::X { "dFdxFine" } else { "dFdyFine" }, &[x])
    }

    fn size(&self, texture: u32) -> Text {
        let name = self.unfiltered(texture);
        match self.resources.texture(texture).kind {
            TextureKind::Multisampled => Text::call("textureSize", &[&name]),
            TextureKind::Layers => {
                let size = Text::call("textureSize", &[&name, &Text::name("0")]);
                Text::member(&size, "xy")
            }
            _ => Text::call("textureSize", &[&name, &Text::name("0")]),
        }
    }

    fn element(&self, buffer: u32, index: &Text) -> Text {
        let elements = Text::name(format!("{}.elements", self.resources.buffer(buffer).name));
        Text::index(&elements, index)
    }

    fn len(&self, buffer: u32) -> Text {
        let length = Text::name(format!("{}{LENGTH}", self.resources.buffer(buffer).name));
        Text::call("int", &[&length])
    }

    fn bitcast(&self, from: Type, to: Type, x: &Text) -> Text {
        let function = match (from.kind(), to.kind()) {
            (Some(Scalar::F32), Some(Scalar::I32)) => "floatBitsToInt",
            (Some(Scalar::F32), _) => "floatBitsToUint",
            (Some(Scalar::I32), Some(Scalar::F32)) => "intBitsToFloat",
            (Some(Scalar::U32), Some(Scalar::F32)) => "uintBitsToFloat",
            _ => return Text::call(&self.ty(to), &[x]),
        };
        Text::call(function, &[x])
    }

    fn unary(&self, op: UnaryOp, ty: Type, x: &Text) -> Text {
        use UnaryOp::*;
        let function = match op {
            Neg => return Text::prefix("-", x),
            Not if ty.lanes() > 1 => "not",
            Not => return Text::prefix("!", x),
            BitNot => return Text::prefix("~", x),
            // Numbered from the lowest bit, and -1 for none.
            LeadingZeros | TrailingZeros => {
                let kind = ty.kind().unwrap_or(Scalar::U32);
                let bits = match kind {
                    Scalar::I32 => Text::call("uint", &[x]),
                    _ => x.clone(),
                };
                let found = Text::call(if op == LeadingZeros { "findMSB" } else { "findLSB" }, &[&bits]);
                let none = Text::infix(&bits, "==", &Text::name("0u"), Binds::Comparison);
                let zeros = match op {
                    LeadingZeros => Text::infix(&Text::name("31"), "-", &found, Binds::Sum),
                    _ => found,
                };
                let count = self.select(ty, &none, &Text::name("32"), &zeros);
                return Text::call(&self.ty(ty), &[&count]);
            }
            CountOneBits => return Text::call(&self.ty(ty), &[&Text::call("bitCount", &[x])]),
            ReverseBits => "bitfieldReverse",
            Sinh => "sinh",
            Cosh => "cosh",
            Tanh => "tanh",
            Abs => "abs",
            Sign => "sign",
            Floor => "floor",
            Ceil => "ceil",
            Round => "roundEven",
            Trunc => "trunc",
            Fract => "fract",
            Saturate => return Text::call("clamp", &[x, &Text::name("0.0"), &Text::name("1.0")]),
            Sqrt => "sqrt",
            InverseSqrt => "inversesqrt",
            Exp => "exp",
            Exp2 => "exp2",
            Log => "log",
            Log2 => "log2",
            Sin => "sin",
            Cos => "cos",
            Tan => "tan",
            Asin => "asin",
            Acos => "acos",
            Atan => "atan",
        };
        Text::call(function, &[x])
    }

    fn binary(&self, op: BinaryOp, ty: Type, x: &Text, y: &Text) -> Text {
        use BinaryOp::*;
        let kind = ty.kind().unwrap_or(Scalar::F32);
        let vector = ty.lanes() > 1;
        let function = match op {
            Min => Some("min"),
            Max => Some("max"),
            Pow => Some("pow"),
            Atan2 => Some("atan"),
            Eq if vector => Some("equal"),
            Ne if vector => Some("notEqual"),
            Xor if vector && kind == Scalar::Bool => Some("notEqual"),
            Lt if vector => Some("lessThan"),
            Le if vector => Some("lessThanEqual"),
            Gt if vector => Some("greaterThan"),
            Ge if vector => Some("greaterThanEqual"),
            _ => None,
        };
        if let Some(function) = function {
            return Text::call(function, &[x, y]);
        }
        match (op, kind) {
            // GLSL's own `%` takes integers only, and its `mod` floors.
            (Rem, Scalar::F32) => {
                let quotient = Text::infix(x, "/", y, Binds::Product);
                let whole = Text::call("trunc", &[&quotient]);
                let back = Text::infix(y, "*", &whole, Binds::Product);
                Text::infix(x, "-", &back, Binds::Sum)
            }
            // GLSL has no `&` of booleans, and glslang makes branches of `&&` and `||` where the right side is not a name or
            // a comparison of two.
            (And | Or, Scalar::Bool) if vector => {
                let words = self.ty(ty.with_scalar(Scalar::U32));
                let [x, y] = [x, y].map(|side| Text::call(&words, &[side]));
                let both = Text::infix(&x, if op == And { "&" } else { "|" }, &y, Binds::Mixed);
                Text::call(&self.ty(ty), &[&both])
            }
            (And | Or, Scalar::Bool) if is_simple(y) => {
                Text::infix(x, if op == And { "&&" } else { "||" }, y, Binds::Mixed)
            }
            (And | Or, Scalar::Bool) => {
                let both = Text::call("bvec2", &[x, y]);
                Text::call(if op == And { "all" } else { "any" }, &[&both])
            }
            (Shl | Shr, _) => {
                let counts = self.construct(ty, &[&self.scalar(kind, 31)]);
                let count = Text::infix(y, "&", &counts, Binds::Mixed);
                Text::infix(x, if op == Shl { "<<" } else { ">>" }, &count, Binds::Mixed)
            }
            _ => {
                let (op, binds) = operator(op, kind).unwrap_or(("+", Binds::Sum));
                Text::infix(x, op, y, binds)
            }
        }
    }

    // glslang makes branches of a choice between more than names and literals, and none of `mix`.
    fn select(&self, ty: Type, condition: &Text, yes: &Text, no: &Text) -> Text {
        if !(is_leaf(&yes.code) && is_leaf(&no.code)) && ty.kind() != Some(Scalar::Bool) {
            let condition = match ty.lanes() {
                1 => condition.clone(),
                _ => Text::call(&self.ty(ty.with_scalar(Scalar::Bool)), &[condition]),
            };
            return Text::call("mix", &[no, yes, &condition]);
        }
        let wrap = |t: &Text| {
            if t.binds <= Binds::Ternary {
                format!("({})", t.code)
            } else {
                t.code.clone()
            }
        };
        Text {
            code: format!("({} ? {} : {})", wrap(condition), wrap(yes), wrap(no)),
            binds: Binds::Primary,
            size: 1 + condition.size + yes.size + no.size,
        }
    }

    // Division by zero gives the dividend and its remainder 0, as in WGSL, and the smallest integer divided by -1 itself; GLSL
    // leaves both open. It leaves the remainder of negative numbers open too, and glslang gives it the sign of the divisor.
    fn divide(&self, op: BinaryOp, ty: Type, x: &Text, y: &Text, known: Division) -> Option<(Text, String)> {
        let signed = ty.kind() == Some(Scalar::I32);
        let quotient = op == BinaryOp::Div;
        if known.defined && (quotient || !signed || known.positive) {
            return None;
        }
        let name = self.ty(ty);
        let all = |code: &str| {
            if ty.lanes() == 1 {
                code.to_owned()
            } else {
                format!("{name}({code})")
            }
        };
        let equal = |x: &str, code: &str| match ty.lanes() {
            1 => format!("{x} == {code}"),
            _ => format!("equal({x}, {name}({code}))"),
        };
        let (zero, one) = if signed { ("0", "1") } else { ("0u", "1u") };
        let mut divisor = format!("mix(y, {}, {})", all(one), equal("y", zero));
        if signed {
            let overflow = match ty.lanes() {
                1 => format!("all(bvec2({}, {}))", equal("x", SMALLEST), equal("y", "-1")),
                lanes => format!(
                    "bvec{lanes}({name}({}) & {name}({}))",
                    equal("x", SMALLEST),
                    equal("y", "-1")
                ),
            };
            divisor = format!("mix({divisor}, {}, {overflow})", all(one));
        }
        let (function, comment, result) = match (quotient, signed) {
            (true, _) => (
                "whole_quotient",
                "x / y, and x where that is not defined.",
                "x / divisor",
            ),
            (false, true) => (
                "whole_remainder",
                "What x / y leaves, with the sign of x, and 0 where it is not defined.",
                "x - divisor * (x / divisor)",
            ),
            (false, false) => (
                "whole_remainder",
                "What x / y leaves, and 0 where it is not defined.",
                "x % divisor",
            ),
        };
        let helper = format!(
            "// {comment}\n{name} {function}({name} x, {name} y) {{\n    {name} divisor = {divisor};\n    return {result};\n}}"
        );
        Some((Text::call(function, &[x, y]), helper))
    }

    // WGSL saturates; GLSL leaves numbers out of range open. Rust has the largest integer for what is too large and 0 for a NaN.
    fn convert(&self, from: Type, to: Type, x: &Text, fits: bool) -> (Text, Option<String>) {
        let name = self.ty(to);
        if !from.is_float() || !to.is_integer() || fits {
            return (Text::call(&name, &[x]), None);
        }
        let signed = to.kind() == Some(Scalar::I32);
        let (floats, words) = (self.ty(from), self.ty(to.with_scalar(Scalar::U32)));
        let all = |ty: &str, code: &str| {
            if to.lanes() == 1 {
                code.to_owned()
            } else {
                format!("{ty}({code})")
            }
        };
        let compare = |function: &str, op: &str, x: &str, y: &str| match to.lanes() {
            1 => format!("{x} {op} {y}"),
            _ => format!("{function}({x}, {y})"),
        };
        let (low, high, limit, largest, zero) = if signed {
            ("-2147483648.0", "2147483520.0", "2147483648.0", "2147483647", "0")
        } else {
            ("0.0", "4294967040.0", "4294967296.0", "4294967295u", "0u")
        };
        let bits = match to.lanes() {
            1 => "(floatBitsToUint(x) & 0x7fffffffu)".to_owned(),
            _ => format!("floatBitsToUint(x) & {words}(0x7fffffffu)"),
        };
        let is_nan = compare("greaterThan", ">", &bits, &all(&words, "0x7f800000u"));
        let too_large = compare("greaterThanEqual", ">=", "x", &all(&floats, limit));
        let helper = format!(
            "// What is out of range becomes the integer next to it, NaN becomes 0.\n{name} to_{name}({floats} x) {{\n    {name} \
             whole = {name}(clamp(x, {low}, {high}));\n    return mix(mix(whole, {}, {too_large}), {}, {is_nan});\n}}",
            all(&name, largest),
            all(&name, zero),
        );
        (Text::call(&format!("to_{name}"), &[x]), Some(helper))
    }

    // GLSL leaves an index outside of an array open; WGSL goes to the last element.
    fn inside(&self, index: &Text, len: u32) -> Text {
        let index = Text::call("uint", &[index]);
        Text::call("min", &[&index, &Text::name(format!("{}u", len - 1))])
    }

    fn non_finite(&self, bits: u32) -> Option<Text> {
        Some(Text::name(format!("uintBitsToFloat({bits:#010x}u)")))
    }

    fn uniform(&self, name: &str) -> Text {
        Text::name(format!("{}.{name}", super::resources::UNIFORMS))
    }
}

//! GLSL 4.50 for Vulkan, with separate textures.

use super::dialect::{Dialect, float, integer, operator};
use super::resources::Resources;
use super::text::{Binds, Text};
use crate::ir::{Axis, BinaryOp, Direction, Scalar, TextureKind, Type, UnaryOp};

/// What follows a buffer's name to ask for its length.
pub const LENGTH: &str = ".elements.length()";

/// Quad operations, horizontal, vertical and diagonal.
pub const MESSAGES: [&str; 3] = [
    "subgroupQuadSwapHorizontal",
    "subgroupQuadSwapVertical",
    "subgroupQuadSwapDiagonal",
];

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
            Scalar::I32 if bits as i32 == i32::MIN => Text::name("(-2147483647 - 1)"),
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
            "for ({} {counter} = {}; {counter} < {}; {counter}++) {{",
            if ty == Type::U32 { "uint" } else { "int" },
            start.code,
            end.code
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

    // naga reads no `textureGather`: the four texels are read one by one at their centres, where filters agree.
    fn gather(&self, texture: u32, sampler: u32, component: u8, uv: &Text) -> (Text, Option<String>) {
        let through = self.through("sampler2D", texture, sampler).code;
        let lane = &"xyzw"[component as usize..=component as usize];
        let function = format!(
            "gather_{}_{}_{lane}",
            self.resources.texture(texture).name,
            self.resources.sampler(sampler).name
        );
        let tap = |x: &str, y: &str| format!("textureLod({through}, (base + vec2({x}, {y})) / size, 0.0).{lane}");
        let text = format!(
            "vec4 {function}(vec2 uv) {{\n    vec2 size = vec2(textureSize({through}, 0));\n    vec2 base = floor(uv * size - \
             0.5);\n    return vec4({}, {}, {}, {});\n}}",
            tap("0.5", "1.5"),
            tap("1.5", "1.5"),
            tap("1.5", "0.5"),
            tap("0.5", "0.5"),
        );
        (Text::call(&function, &[uv]), Some(text))
    }

    fn compare(&self, texture: u32, sampler: u32, uv: &Text, reference: &Text) -> Text {
        let through = self.through("sampler2DShadow", texture, sampler);
        let place = Text::call("vec3", &[uv, reference]);
        Text::call("textureLod", &[&through, &place, &Text::name("0.0")])
    }

    // naga reads no `textureGather`: as of colours, the four are compared one by one at their centres.
    fn gather_compare(&self, texture: u32, sampler: u32, uv: &Text, reference: &Text) -> (Text, Option<String>) {
        let through = self.through("sampler2DShadow", texture, sampler).code;
        let function = format!(
            "gather_compare_{}_{}",
            self.resources.texture(texture).name,
            self.resources.sampler(sampler).name
        );
        let tap =
            |x: &str, y: &str| format!("textureLod({through}, vec3((base + vec2({x}, {y})) / size, reference), 0.0)");
        let text = format!(
            "vec4 {function}(vec2 uv, float reference) {{\n    vec2 size = vec2(textureSize({through}, 0));\n    vec2 base = \
             floor(uv * size - 0.5);\n    return vec4({}, {}, {}, {});\n}}",
            tap("0.5", "1.5"),
            tap("1.5", "1.5"),
            tap("1.5", "0.5"),
            tap("0.5", "0.5"),
        );
        (Text::call(&function, &[uv, reference]), Some(text))
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
                let count = self.select(&none, &Text::name("32"), &zeros);
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
            // Division by zero gives the dividend and its remainder 0, as in WGSL; GLSL leaves it open.
            (Div | Rem, Scalar::I32 | Scalar::U32) if y.code.parse::<i64>().is_err() && !vector => {
                let zero = self.scalar(kind, 0);
                let none = Text::infix(y, "==", &zero, Binds::Comparison);
                let (op, binds) = operator(op, kind).unwrap_or(("/", Binds::Product));
                let some = Text::infix(x, op, y, binds);
                let fallback = if op == "/" { x.clone() } else { zero };
                self.select(&none, &fallback, &some)
            }
            // A constant has no lane of 0 left.
            (Div | Rem, Scalar::I32 | Scalar::U32) if vector && !(y.size == 0 && y.code.ends_with(')')) => {
                // A lane of 0 becomes 1, which gives the same.
                let ty_name = self.ty(ty);
                let zero = Text::call(&ty_name, &[&self.scalar(kind, 0)]);
                let none = Text::call("equal", &[y, &zero]);
                let mended = Text::infix(y, "+", &Text::call(&ty_name, &[&none]), Binds::Sum);
                let (op, binds) = operator(op, kind).unwrap_or(("/", Binds::Product));
                Text::infix(x, op, &mended, binds)
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

    fn select(&self, condition: &Text, yes: &Text, no: &Text) -> Text {
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

    fn convert(&self, from: Type, to: Type, x: &Text, _: bool) -> Text {
        // WGSL saturates; GLSL leaves numbers out of range open.
        let bounds = match (from.kind(), to.kind()) {
            (Some(Scalar::F32), Some(Scalar::I32)) => Some(("-2147483648.0", "2147483520.0")),
            (Some(Scalar::F32), Some(Scalar::U32)) => Some(("0.0", "4294967040.0")),
            _ => None,
        };
        let x = match bounds {
            Some((low, high)) => Text::call("clamp", &[x, &Text::name(low), &Text::name(high)]),
            None => x.clone(),
        };
        Text::call(&self.ty(to), &[&x])
    }

    fn uniform(&self, name: &str) -> Text {
        Text::name(format!("{}.{name}", super::resources::UNIFORMS))
    }
}

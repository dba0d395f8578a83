//! WGSL.

use super::dialect::{Dialect, float, integer, operator};
use super::resources::Resources;
use super::text::{Binds, Text};
use crate::ir::{Axis, BinaryOp, Direction, Scalar, TextureKind, Type, UnaryOp};
use straightline_manifest::Precision;

/// WGSL as WebGPU and wgpu read it.
pub struct Wgsl<'a> {
    /// The shader's bindings.
    pub resources: &'a Resources,
}

impl Wgsl<'_> {
    fn names(&self, texture: u32, sampler: u32) -> [Text; 2] {
        let texture = self.resources.texture(texture).name.as_str();
        let sampler = self.resources.sampler(sampler).name.as_str();
        [texture, sampler].map(Text::name)
    }

    fn is_half(&self) -> bool {
        self.resources.options.precision == Precision::F16
    }
}

impl Dialect for Wgsl<'_> {
    fn name(&self) -> &'static str {
        "wgsl"
    }

    fn ty(&self, ty: Type) -> String {
        match (ty, self.is_half() && ty.is_float()) {
            (Type::Array { len, .. }, true) => format!("array<{}, {len}>", self.ty(ty.element())),
            (Type::Value { lanes: 1, .. }, true) => "f16".to_owned(),
            (Type::Value { lanes, .. }, true) => format!("vec{lanes}h"),
            _ => type_name(ty),
        }
    }

    fn outside(&self, ty: Type) -> String {
        type_name(ty)
    }

    fn enter(&self, ty: Type, x: Text) -> Text {
        if self.is_half() && ty.is_float() {
            Text::call(&self.ty(ty), &[&x])
        } else {
            x
        }
    }

    fn leave(&self, ty: Type, x: Text) -> Text {
        if self.is_half() && ty.is_float() {
            Text::call(&type_name(ty), &[&x])
        } else {
            x
        }
    }

    fn scalar(&self, kind: Scalar, bits: u32) -> Text {
        match kind {
            Scalar::F32 if self.is_half() => super::half::literal(bits),
            Scalar::F32 => float(bits),
            Scalar::I32 if bits as i32 == i32::MIN => Text::name("i32(-2147483648)"),
            Scalar::I32 => integer(i64::from(bits as i32), ""),
            Scalar::U32 => integer(i64::from(bits), "u"),
            Scalar::Bool => Text::name(if bits != 0 { "true" } else { "false" }),
        }
    }

    fn immutable(&self, name: &str, _: Type, value: &str) -> String {
        format!("let {name} = {value};")
    }

    fn mutable(&self, name: &str, ty: Type, value: Option<&str>) -> String {
        match value {
            Some(value) => format!("var {name} = {value};"),
            None => format!("var {name}: {};", self.ty(ty)),
        }
    }

    fn table(&self, name: &str, _: Type, value: &str) -> String {
        format!("const {name} = {value};")
    }

    fn loop_head(&self, counter: &str, _: Type, start: &Text, end: &Text) -> String {
        format!(
            "for (var {counter} = {}; {}; {counter}++) {{",
            start.code,
            Text::infix(&Text::name(counter), "<", end, Binds::Comparison).code
        )
    }

    fn if_head(&self, condition: &Text) -> String {
        format!("if {} {{", condition.code)
    }

    fn load(&self, texture: u32, coord: &Text, layer: Option<&Text>) -> Text {
        let texture = self.resources.texture(texture);
        let name = Text::name(texture.name.as_str());
        let level = Text::name("0");
        let mut args = vec![&name, coord];
        args.extend(layer);
        if texture.kind != TextureKind::Multisampled {
            args.push(&level);
        }
        let texel = Text::call("textureLoad", &args);
        match texture.components {
            4 => texel,
            // A depth texture gives a single number.
            _ if texture.kind == TextureKind::Depth => texel,
            n => Text::member(&texel, &"xyzw"[..n as usize]),
        }
    }

    fn sample(&self, texture: u32, sampler: u32, uv: &Text) -> Text {
        let components = self.resources.texture(texture).components;
        let [texture, sampler] = self.names(texture, sampler);
        let texel = Text::call("textureSampleLevel", &[&texture, &sampler, uv, &Text::name("0.0")]);
        match components {
            4 => texel,
            n => Text::member(&texel, &"xyzw"[..n as usize]),
        }
    }

    fn gather(&self, texture: u32, sampler: u32, component: u8, uv: &Text) -> Text {
        let [texture, sampler] = self.names(texture, sampler);
        let component = Text::name(component.to_string());
        Text::call("textureGather", &[&component, &texture, &sampler, uv])
    }

    fn compare(&self, texture: u32, sampler: u32, uv: &Text, reference: &Text) -> Text {
        let [texture, sampler] = self.names(texture, sampler);
        Text::call("textureSampleCompareLevel", &[&texture, &sampler, uv, reference])
    }

    fn gather_compare(&self, texture: u32, sampler: u32, uv: &Text, reference: &Text) -> Text {
        let [texture, sampler] = self.names(texture, sampler);
        Text::call("textureGatherCompare", &[&texture, &sampler, uv, reference])
    }

    fn message(&self, direction: Direction, x: &Text) -> Text {
        let function = match direction {
            Direction::Horizontal => "quadSwapX",
            Direction::Vertical => "quadSwapY",
            Direction::Diagonal => "quadSwapDiagonal",
        };
        Text::call(function, &[x])
    }

    fn derivative(&self, axis: Axis, x: &Text) -> Text {
        Text::call(if axis == Axis::X { "dpdxFine" } else { "dpdyFine" }, &[x])
    }

    fn size(&self, texture: u32) -> Text {
        let name = Text::name(self.resources.texture(texture).name.as_str());
        Text::call("vec2i", &[&Text::call("textureDimensions", &[&name])])
    }

    fn element(&self, buffer: u32, index: &Text) -> Text {
        Text::index(&Text::name(self.resources.buffer(buffer).name.as_str()), index)
    }

    fn len(&self, buffer: u32) -> Text {
        let name = Text::name(format!("&{}", self.resources.buffer(buffer).name));
        Text::call("i32", &[&Text::call("arrayLength", &[&name])])
    }

    // Bits are those of an `f32` in every precision.
    fn bitcast(&self, from: Type, to: Type, x: &Text) -> Text {
        let x = self.leave(from, x.clone());
        self.enter(to, Text::call(&format!("bitcast<{}>", type_name(to)), &[&x]))
    }

    fn unary(&self, op: UnaryOp, _: Type, x: &Text) -> Text {
        use UnaryOp::*;
        let function = match op {
            Neg => return Text::prefix("-", x),
            Not => return Text::prefix("!", x),
            BitNot => return Text::prefix("~", x),
            Abs => "abs",
            Sign => "sign",
            Floor => "floor",
            Ceil => "ceil",
            Round => "round",
            Trunc => "trunc",
            Fract => "fract",
            Saturate => "saturate",
            Sqrt => "sqrt",
            InverseSqrt => "inverseSqrt",
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
            Sinh => "sinh",
            Cosh => "cosh",
            Tanh => "tanh",
            CountOneBits => "countOneBits",
            ReverseBits => "reverseBits",
            LeadingZeros => "countLeadingZeros",
            TrailingZeros => "countTrailingZeros",
        };
        Text::call(function, &[x])
    }

    fn binary(&self, op: BinaryOp, ty: Type, x: &Text, y: &Text) -> Text {
        let kind = ty.kind().unwrap_or(Scalar::F32);
        if matches!(op, BinaryOp::Shl | BinaryOp::Shr) {
            // WGSL shifts by unsigned counts, and makes a constant count of 32 or more an error.
            let counts = ty.with_scalar(Scalar::U32);
            let count = if kind == Scalar::U32 {
                y.clone()
            } else {
                Text::call(&self.ty(counts), &[y])
            };
            let mask = Text::call(&self.ty(counts), &[&Text::name("31u")]);
            let count = Text::infix(&count, "&", &mask, Binds::Mixed);
            let op = if op == BinaryOp::Shl { "<<" } else { ">>" };
            return Text::infix(x, op, &count, Binds::Mixed);
        }
        match operator(op, kind) {
            Some((op, binds)) => Text::infix(x, op, y, binds),
            None => {
                let function = match op {
                    BinaryOp::Min => "min",
                    BinaryOp::Max => "max",
                    BinaryOp::Pow => "pow",
                    _ => "atan2",
                };
                Text::call(function, &[x, y])
            }
        }
    }

    fn select(&self, ty: Type, condition: &Text, yes: &Text, no: &Text) -> Text {
        if ty.kind() == Some(Scalar::Bool) {
            // `a < b, c, d > e` would begin a list of template arguments.
            return Text::call("select", &[&no.in_parentheses(), &yes.in_parentheses(), condition]);
        }
        Text::call("select", &[no, yes, condition])
    }

    // Between half precision and integers by way of `f32`, which holds every `f16`, and every integer that an `f16` holds:
    // whatever a driver does of its own is what it does in full precision.
    fn convert(&self, from: Type, to: Type, x: &Text, fits: bool) -> (Text, Option<String>) {
        let x = self.leave(from, x.clone());
        if from.is_float() && to.is_integer() && !fits {
            let (name, helper) = saturating(to);
            return (Text::call(&name, &[&x]), Some(helper));
        }
        let mut converted = Text::call(&type_name(to), &[&x]);
        if self.is_half() && from.is_integer() && to.is_float() && !fits {
            let bound = |code: &str| match to.lanes() {
                1 => Text::name(code),
                _ => Text::call(&type_name(to), &[&Text::name(code)]),
            };
            converted = Text::call("clamp", &[&converted, &bound("-65504.0"), &bound("65504.0")]);
        }
        (self.enter(to, converted), None)
    }

    fn uniform(&self, name: &str) -> Text {
        Text::name(format!("{}.{name}", super::resources::UNIFORMS))
    }
}

/// A function that converts floats as Rust does. WGSL's own conversion goes to the nearest integer that an `f32` has too, which
/// is not the largest one, and leaves NaN open.
fn saturating(to: Type) -> (String, String) {
    let from = type_name(to.with_scalar(Scalar::F32));
    let words = type_name(to.with_scalar(Scalar::U32));
    let to_name = type_name(to);
    let name = format!("to_{to_name}");
    let (limit, largest, zero) = match to.kind() {
        Some(Scalar::I32) => ("2147483648.0", "2147483647", "0"),
        _ => ("4294967296.0", "4294967295u", "0u"),
    };
    let all = |ty: &str, code: &str| {
        if to.lanes() == 1 {
            code.to_owned()
        } else {
            format!("{ty}({code})")
        }
    };
    let text = format!(
        "// What is too large becomes the largest integer, NaN becomes 0.\nfn {name}(x: {from}) -> {to_name} {{\n    let is_nan = \
         (bitcast<{words}>(x) & {}) > {};\n    let saturated = select({to_name}(x), {}, x >= {});\n    return select(saturated, \
         {}, is_nan);\n}}",
        all(&words, "0x7fffffffu"),
        all(&words, "0x7f800000u"),
        all(&to_name, largest),
        all(&from, limit),
        all(&to_name, zero),
    );
    (name, text)
}

/// A type as WGSL spells it.
pub fn type_name(ty: Type) -> String {
    match ty {
        Type::Value { scalar, lanes: 1 } => scalar.to_string(),
        Type::Value {
            scalar: Scalar::Bool,
            lanes,
        } => format!("vec{lanes}<bool>"),
        Type::Value { scalar, lanes } => format!("vec{lanes}{}", &scalar.to_string()[..1]),
        Type::Array { len, .. } => format!("array<{}, {len}>", type_name(ty.element())),
        Type::Results => "void".to_owned(),
    }
}

//! The constant `SHADER`: a text and its binding plan, each checked against the other.

use super::Module;
use crate::emit::refusal::Refusal;
use proc_macro2::{Literal, TokenStream, TokenTree};
use quote::{format_ident, quote};
use std::collections::BTreeSet;
use straightline_manifest::plan::{
    FieldPlan, InputKind, InputPlan, OutputPlan, OverridePlan, PartPlan, Plan, StagePlan, UniformPlan, VaryingPlan,
};
use straightline_manifest::{Scalar, ValueType, text_hash};

/// Size in bytes at which rustc's lint of long constant evaluations may fire while hashing a text.
const LONG: usize = 100_000;

/// Returns the constant `SHADER` of a module.
///
/// # Errors
///
/// If the text is not the shader that the manifest describes: a bug of the emitter.
pub fn quote_shader(module: &Module<'_>) -> Result<TokenStream, Refusal> {
    let Module { manifest, wgsl, .. } = module;
    let refused = |problem: String| Refusal::invalid_text(&manifest.kernel, "wgsl", &problem);
    let plan = Plan::from_manifest(manifest).map_err(|contradiction| refused(contradiction.to_string()))?;
    let parsed = straightline_reflect::Shader::parse(wgsl).map_err(refused)?;
    parsed.check(manifest, &plan).map_err(refused)?;
    let loops = match parsed.check_loops() {
        Ok(()) => quote! { straightline_runtime::loops_end!() },
        Err(problem) => quote! { Loops::Unproven(Borrowed(#problem)) },
    };
    let hash = hex_literal(text_hash(wgsl));
    let plan = plan_of(&plan);
    let value = quote! { Shader::generated(WGSL, #hash, #loops, #plan) };
    let words = imported_items(&value);
    let allow = (wgsl.len() > LONG).then(|| quote! { #[allow(long_running_const_eval)] });
    Ok(quote! {
        /// The shader with its bindings, computed when it was generated: creating a pass parses nothing.
        #allow
        pub static SHADER: straightline_runtime::Shader<'static> = {
            use straightline_runtime::Shader;
            use straightline_runtime::plan::{#(#words),*};

            #value
        };
    })
}

/// Items of `straightline_runtime::plan` that may be named.
const WORDS: [&str; 22] = [
    "Borrowed",
    "BufferPlan",
    "Dimension",
    "Extent",
    "FieldPlan",
    "Format",
    "InputKind",
    "InputPlan",
    "Loops",
    "OutputPlan",
    "OverridePlan",
    "OverrideType",
    "PartPlan",
    "Plan",
    "SampleType",
    "SamplerType",
    "Scalar",
    "StagePlan",
    "TexturePlan",
    "UniformPlan",
    "ValueType",
    "VaryingPlan",
];

/// Returns the items that `tokens` name, by name.
fn imported_items(tokens: &TokenStream) -> Vec<proc_macro2::Ident> {
    fn collect_idents(tokens: &TokenStream, found: &mut BTreeSet<String>) {
        for token in tokens.clone() {
            match token {
                TokenTree::Group(group) => collect_idents(&group.stream(), found),
                TokenTree::Ident(ident) => {
                    found.insert(ident.to_string());
                }
                _ => {}
            }
        }
    }
    let mut found = BTreeSet::new();
    collect_idents(tokens, &mut found);
    WORDS
        .into_iter()
        .filter(|word| found.contains(*word))
        .map(|word| format_ident!("{word}"))
        .collect()
}

/// Formats a hash in groups of four digits.
fn hex_literal(hash: u64) -> Literal {
    let group = |shift: u32| (hash >> shift) & 0xffff;
    let text = format!(
        "0x{:04x}_{:04x}_{:04x}_{:04x}",
        group(48),
        group(32),
        group(16),
        group(0)
    );
    text.parse().expect("a literal")
}

fn plan_of(plan: &Plan) -> TokenStream {
    let Plan {
        kernel,
        entry_point,
        stage,
        block: [across, down],
        features,
        inputs,
        uniforms,
        region,
        overrides,
        varyings,
        outputs,
    } = plan;
    let (kernel, entry_point) = (&**kernel, &**entry_point);
    let stage = match stage {
        StagePlan::Compute { fills_memory, .. } => {
            quote! { StagePlan::Compute { workgroup: WORKGROUP_SIZE, fills_memory: #fills_memory } }
        }
        StagePlan::Fragment => quote! { StagePlan::Fragment },
    };
    let (across, down) = (Literal::u32_unsuffixed(*across), Literal::u32_unsuffixed(*down));
    let features = features.iter().map(|feature| quote! { Borrowed(#feature) });
    let inputs = inputs.iter().map(quote_input);
    let uniforms = uniforms.iter().map(quote_uniform);
    let region = quote_option(region.as_ref().map(quote_uniform));
    let overrides = overrides.iter().map(quote_override);
    let varyings = varyings.iter().map(quote_varying);
    let outputs = outputs.iter().map(quote_output);
    quote! {
        Plan {
            kernel: Borrowed(#kernel),
            entry_point: Borrowed(#entry_point),
            stage: #stage,
            block: [#across, #down],
            features: Borrowed(&[#(#features),*]),
            inputs: Borrowed(&[#(#inputs),*]),
            uniforms: Borrowed(&[#(#uniforms),*]),
            region: #region,
            overrides: Borrowed(&[#(#overrides),*]),
            varyings: Borrowed(&[#(#varyings),*]),
            outputs: Borrowed(&[#(#outputs),*]),
        }
    }
}

fn quote_input(input: &InputPlan) -> TokenStream {
    let InputPlan {
        name,
        group,
        binding,
        kind,
    } = input;
    let (group, binding) = (Literal::u32_unsuffixed(*group), Literal::u32_unsuffixed(*binding));
    let kind = match kind {
        InputKind::Texture(texture) => {
            let (dimension, sample_type) = (variant_name(&texture.dimension), variant_name(&texture.sample_type));
            let components = Literal::u8_unsuffixed(texture.components);
            let layers = Literal::u32_unsuffixed(texture.layers);
            let samples = Literal::u32_unsuffixed(texture.samples);
            let extent = variant_name(&texture.extent);
            quote! {
                InputKind::Texture(TexturePlan {
                    dimension: Dimension::#dimension,
                    sample_type: SampleType::#sample_type,
                    components: #components,
                    layers: #layers,
                    samples: #samples,
                    extent: Extent::#extent,
                })
            }
        }
        InputKind::Sampler(sampler) => {
            let sampler = variant_name(sampler);
            quote! { InputKind::Sampler(SamplerType::#sampler) }
        }
        InputKind::Buffer(buffer) => {
            let element = quote_option(buffer.element.map(value_type));
            let stride = Literal::u32_unsuffixed(buffer.stride);
            let written = buffer.written;
            quote! { InputKind::Buffer(BufferPlan { element: #element, stride: #stride, written: #written }) }
        }
    };
    quote! { InputPlan { name: Borrowed(#name), group: #group, binding: #binding, kind: #kind } }
}

fn quote_uniform(uniform: &UniformPlan) -> TokenStream {
    let UniformPlan {
        name,
        place,
        size,
        fields,
    } = uniform;
    let (place, size) = (quote_place(*place), Literal::u32_unsuffixed(*size));
    let fields = fields.iter().map(quote_field);
    quote! {
        UniformPlan {
            name: Borrowed(#name),
            place: #place,
            size: #size,
            fields: Borrowed(&[#(#fields),*]),
        }
    }
}

fn quote_field(field: &FieldPlan) -> TokenStream {
    let FieldPlan {
        name,
        ty,
        offset,
        default,
        part,
        frame_size,
    } = field;
    let offset = Literal::u32_unsuffixed(*offset);
    let default = quote_option(default.map(|word| {
        let number = quote_number(ty.scalar(), word);
        quote! { #number.to_le_bytes() }
    }));
    let part = quote_option(part.as_ref().map(|PartPlan { of, ty, index }| {
        let (ty, index) = (value_type(*ty), Literal::u32_unsuffixed(*index));
        quote! { PartPlan { of: Borrowed(#of), ty: #ty, index: #index } }
    }));
    let ty = value_type(*ty);
    quote! { FieldPlan { name: Borrowed(#name), ty: #ty, offset: #offset, default: #default, part: #part, frame_size: #frame_size } }
}

/// Returns a number with these bits, in a form that a method call can follow.
fn quote_number(scalar: Scalar, word: [u8; 4]) -> TokenStream {
    let text = match scalar {
        Scalar::F32 => format!("{:?}_f32", f32::from_le_bytes(word)),
        Scalar::I32 => format!("{}_i32", i32::from_le_bytes(word)),
        Scalar::U32 => format!("{}_u32", u32::from_le_bytes(word)),
    };
    let literal = |text: &str| text.parse::<Literal>().expect("a literal");
    match text.strip_prefix('-') {
        Some(positive) => {
            let positive = literal(positive);
            quote! { (-#positive) }
        }
        None => {
            let positive = literal(&text);
            quote! { #positive }
        }
    }
}

fn quote_override(of: &OverridePlan) -> TokenStream {
    let OverridePlan {
        name,
        id,
        ty,
        default,
        range,
    } = of;
    let (id, ty) = (Literal::u32_unsuffixed(*id), variant_name(ty));
    let range = quote_option(range.map(|[low, high]| quote! { [#low, #high] }));
    quote! { OverridePlan { name: Borrowed(#name), id: #id, ty: OverrideType::#ty, default: #default, range: #range } }
}

fn quote_varying(varying: &VaryingPlan) -> TokenStream {
    let VaryingPlan { name, ty, location } = varying;
    let (ty, location) = (value_type(*ty), Literal::u32_unsuffixed(*location));
    quote! { VaryingPlan { name: Borrowed(#name), ty: #ty, location: #location } }
}

/// Returns bind group and binding number, if there are any.
fn quote_place(place: Option<(u32, u32)>) -> TokenStream {
    quote_option(place.map(|(group, binding)| {
        let [group, binding] = [group, binding].map(Literal::u32_unsuffixed);
        quote! { (#group, #binding) }
    }))
}

fn quote_output(output: &OutputPlan) -> TokenStream {
    let OutputPlan {
        name,
        place,
        format,
        tile,
    } = output;
    let place = quote_place(*place);
    let tile = quote_option(tile.map(|sides| {
        let [width, height] = sides.map(Literal::u32_unsuffixed);
        quote! { [#width, #height] }
    }));
    let format = variant_name(format);
    quote! { OutputPlan { name: Borrowed(#name), place: #place, format: Format::#format, tile: #tile } }
}

fn value_type(ty: ValueType) -> TokenStream {
    let scalar = variant_name(&ty.scalar());
    match ty {
        ValueType::Scalar(_) => quote! { ValueType::Scalar(Scalar::#scalar) },
        ValueType::Vector { components, .. } => {
            let components = Literal::u8_unsuffixed(components);
            quote! { ValueType::Vector { of: Scalar::#scalar, components: #components } }
        }
        ValueType::Matrix { columns, rows } => {
            let [columns, rows] = [columns, rows].map(Literal::u8_unsuffixed);
            quote! { ValueType::Matrix { columns: #columns, rows: #rows } }
        }
        ValueType::Array { components, count, .. } => {
            let (components, count) = (Literal::u8_unsuffixed(components), Literal::u32_unsuffixed(count));
            quote! { ValueType::Array { of: Scalar::#scalar, components: #components, count: #count } }
        }
    }
}

/// Returns the name of a variant without fields, as `Debug` prints it.
pub(super) fn variant_name(value: &impl std::fmt::Debug) -> proc_macro2::Ident {
    format_ident!("{value:?}")
}

pub(super) fn quote_option(value: Option<TokenStream>) -> TokenStream {
    match value {
        Some(value) => quote! { Some(#value) },
        None => quote! { None },
    }
}

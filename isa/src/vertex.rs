//! A vertex shader to stand before fragment shaders.

/// A triangle over the whole target, as SPIR-V; its entry point is `corner`.
pub fn triangle_words() -> Vec<u32> {
    let text = "@vertex fn corner(@builtin(vertex_index) k: u32) -> @builtin(position) vec4f {\n\
                return vec4f(f32(k & 1u) * 4.0 - 1.0, f32(k >> 1u) * 4.0 - 1.0, 0.0, 1.0); }";
    let module = naga::front::wgsl::parse_str(text).expect("it is a constant that a test reads");
    let mut validator =
        naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
    let info = validator.validate(&module).expect("as above");
    let options = naga::back::spv::Options::default();
    naga::back::spv::write_vec(&module, &info, &options, None).expect("as above")
}

#[cfg(test)]
mod tests {
    #[test]
    fn is_a_module() {
        assert_eq!(super::triangle_words()[0], 0x0723_0203);
    }
}

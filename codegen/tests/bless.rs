#[test]
fn bless() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../shaders-out");
    let expected = straightline_codegen::default_set::files().expect("emitted");
    straightline_codegen::files::write_all(&folder, &expected).expect("written");
}

fn main() -> Result<(), straightline_codegen::config::Error> {
    straightline_codegen::compile(["src/kernels/lens.rs"])
}

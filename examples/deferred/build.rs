//! Turns the built-in SRAA kernel into a shader, and the Rust that binds it.

fn main() -> Result<(), straightline_codegen::config::Error> {
    straightline_codegen::Config::new()
        .kernel("sraa", |k| {
            // Four samples of geometry a pixel, of which the first is shaded. How steep depth may be is set each frame.
            k.set("pattern", "latin4").set("shading", "sample0").set("depth-scale", "uniform")
        })
        .compile()
}

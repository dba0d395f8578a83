//! Words that have a meaning of their own.

/// Keywords and built-in functions of GLSL that a value of a kernel might be called. Types that come in families are
/// told by their form.
#[rustfmt::skip]
pub const GLSL: &[&str] = &[
    "abs", "acos", "acosh", "active", "all", "any", "asin", "asinh", "asm", "atan", "atanh", "atomic_uint",
    "attribute", "bitCount", "bitfieldReverse", "bool", "break", "buffer", "case", "cast", "ceil", "centroid",
    "clamp", "class", "coherent", "common", "const", "continue", "cos", "cosh", "cross", "dFdx", "dFdy", "default",
    "degrees", "demote", "determinant", "discard", "distance", "do", "dot", "double", "else", "enum", "equal", "exp",
    "exp10", "exp2", "extern", "external", "faceforward", "false", "filter", "findLSB", "findMSB", "fixed", "flat",
    "float", "floatBitsToInt", "floatBitsToUint", "floor", "fma", "for", "fract", "frexp", "ftransform", "fvec2",
    "fvec3", "fvec4", "fwidth", "goto", "greaterThan", "greaterThanEqual", "half", "highp", "hvec2", "hvec3", "hvec4",
    "if", "in", "inline", "inout", "input", "int", "intBitsToFloat", "interface", "invariant", "inverse",
    "inversesqrt", "isinf", "isnan", "layout", "ldexp", "length", "lessThan", "lessThanEqual", "log", "log2", "long",
    "lowp", "main", "matrixCompMult", "max", "mediump", "min", "mix", "mod", "modf", "mulExtended", "namespace",
    "noinline", "noperspective", "normalize", "not", "notEqual", "out", "outerProduct", "output", "partition",
    "patch", "pow", "precise", "precision", "public", "radians", "readonly", "reflect", "refract", "resource",
    "restrict", "return", "round", "roundEven", "sample", "sampler3DRect", "shared", "short", "sign", "sin", "sinh",
    "sizeof", "smooth", "smoothstep", "sqrt", "static", "step", "struct", "subroutine", "superp", "switch", "tan",
    "tanh", "template", "texelFetch", "textureLod", "textureSize", "this", "transpose", "true", "trunc", "typedef",
    "uint", "uintBitsToFloat", "uniform", "union", "unsigned", "using", "varying", "void", "volatile", "while",
    "writeonly",
];

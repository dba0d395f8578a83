//! Traits of Rust that kernels name.

/// Traits of Rust whose functions nothing calls by their names: operators, and the end of a scope.
pub const OPERATORS: [&str; 32] = [
    "Add",
    "AddAssign",
    "BitAnd",
    "BitAndAssign",
    "BitOr",
    "BitOrAssign",
    "BitXor",
    "BitXorAssign",
    "Div",
    "DivAssign",
    "From",
    "Index",
    "IndexMut",
    "Mul",
    "MulAssign",
    "Neg",
    "Not",
    "Ord",
    "PartialEq",
    "PartialOrd",
    "Product",
    "Rem",
    "RemAssign",
    "Shl",
    "ShlAssign",
    "Shr",
    "ShrAssign",
    "Sub",
    "SubAssign",
    "Sum",
    "Into",
    "Default",
];

/// Traits of Rust that the generator gives a meaning of its own, so that none can be given by hand.
pub const OWN: [&str; 4] = ["Drop", "Deref", "DerefMut", "Iterator"];

/// Further traits of Rust's prelude, which kernels have no use for.
pub const OF_STD: [&str; 13] = [
    "AsMut",
    "AsRef",
    "DoubleEndedIterator",
    "ExactSizeIterator",
    "Extend",
    "FromIterator",
    "Send",
    "Sync",
    "ToOwned",
    "ToString",
    "TryFrom",
    "TryInto",
    "Unpin",
];

/// Returns whether a trait is one of Rust's whose functions nothing calls by their names.
pub fn is_operator(name: &str) -> bool {
    OPERATORS.contains(&name)
}

/// Returns whether a trait is one of Rust's that may bound the functions of kernels.
pub fn is_of_rust(name: &str) -> bool {
    OPERATORS.contains(&name)
        || OWN.contains(&name)
        || [
            "Copy",
            "Clone",
            "Sized",
            "Eq",
            "Debug",
            "Fn",
            "FnMut",
            "FnOnce",
            "IntoIterator",
        ]
        .contains(&name)
}

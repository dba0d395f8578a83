//! Constructs that kernels are made of.

/// A group of constructs that can be left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// `&mut` parameters, receivers, locals and loops.
    Mutable,
    /// Integer literals without a type where the type is not `i32`.
    Inferred,
    /// Loops over `u32` and `usize`.
    UnsignedLoops,
    /// Calls that change variables, within expressions.
    Effects,
    /// Loops whose bounds are runtime values.
    RuntimeLoops,
    /// `unroll` and `branch` attributes.
    Attributes,
    /// `Mat2` to `Mat4`.
    Matrices,
    /// Enums and `match` on them.
    Enums,
    /// Closures, functions as values, adaptors of iterators.
    Closures,
    /// Functions that the generator has as text of the kernel language.
    Library,
    /// `match` on runtime values, guards, `if let`, `let ... else`, `matches!`, `while let`.
    Matching,
    /// Generic functions.
    Generics,
    /// Arrays of structures, of tuples and of arrays.
    Nested,
    /// Slices of arrays.
    Slices,
    /// Labelled loops, `break`, `continue`, early `return`.
    Leaving,
    /// As `Leaving`, under conditions that are runtime values, and in loops left in the shader.
    RuntimeLeaving,
    /// `while` and `loop`.
    While,
    /// `options!`.
    Options,
    /// Division, roots and what else a driver may compute in other bits.
    Coarse,
    /// Ranges that end at the largest numbers.
    Edges,
    /// Floats at which functions change their ways: halves, and of what is `Coarse` all others.
    Extremes,
    /// `Option`, enums that hold values, blocks with labels and loops that give values.
    Choices,
    /// Traits, operators of structures.
    Traits,
    /// Kernels of one frame, one buffer and one colour; without it all kernels take further shapes.
    Plain,
    /// Buffers and textures of every kind, samplers, uniforms that are structures and arrays.
    Inputs,
    /// Several values for each pixel, or one that is no colour.
    Outputs,
    /// Writes to buffers.
    Writes,
    /// Writes whose result depends on which pixel comes first.
    Ordered,
    /// Workgroups.
    Workgroups,
    /// Orders of structures, tuples, arrays, enums and options; discriminants of enums.
    Orders,
    /// `&dyn Trait`.
    Objects,
    /// Runtime indices into arrays of structures, tuples, enums, options, matrices and arrays.
    Aggregates,
    /// Iterators over ranges with runtime bounds.
    Lazy,
    /// Further adaptors of iterators, and methods of slices.
    Adaptors,
    /// Closures and functions in structures and arrays.
    Held,
    /// Structures generic over constants, and associated types.
    Spaces,
}

/// All features.
pub const ALL: &[Feature] = &[
    Feature::Mutable,
    Feature::Inferred,
    Feature::UnsignedLoops,
    Feature::Effects,
    Feature::RuntimeLoops,
    Feature::Attributes,
    Feature::Matrices,
    Feature::Enums,
    Feature::Closures,
    Feature::Library,
    Feature::Matching,
    Feature::Generics,
    Feature::Nested,
    Feature::Slices,
    Feature::Leaving,
    Feature::RuntimeLeaving,
    Feature::While,
    Feature::Options,
    Feature::Coarse,
    Feature::Edges,
    Feature::Extremes,
    Feature::Choices,
    Feature::Traits,
    Feature::Plain,
    Feature::Inputs,
    Feature::Outputs,
    Feature::Writes,
    Feature::Ordered,
    Feature::Workgroups,
    Feature::Orders,
    Feature::Objects,
    Feature::Aggregates,
    Feature::Lazy,
    Feature::Adaptors,
    Feature::Held,
    Feature::Spaces,
];

/// A set of features.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Features(u64);

impl Features {
    /// Everything.
    pub fn all() -> Features {
        Features(u64::MAX)
    }

    /// Features that all drivers compute in the same bits.
    pub fn exact_on_drivers() -> Features {
        Features::all().on_drivers()
    }

    /// The set without what drivers may compute in other bits.
    pub fn on_drivers(self) -> Features {
        self.without(Feature::Coarse).without(Feature::Ordered)
    }

    /// The set without one of its features.
    pub fn without(self, feature: Feature) -> Features {
        Features(self.0 & !(1 << feature as u64))
    }

    /// Returns whether a feature is in the set.
    pub fn has(self, feature: Feature) -> bool {
        self.0 & (1 << feature as u64) != 0
    }

    /// The feature of a name, as `{:?}` prints it.
    pub fn named(name: &str) -> Option<Feature> {
        ALL.iter()
            .copied()
            .find(|f| format!("{f:?}").eq_ignore_ascii_case(name))
    }
}

//! Types of a shader's constants, for generated code: see [`Shader`](crate::Shader).

pub use crate::shader::{Loops, LoopsEnd};
pub use std::borrow::Cow::Borrowed;
pub use straightline_manifest::chain::{
    CHAIN_SCHEMA, ChainPlan, PassPlan, PicturePlan, ReadPlan, SizeOp, SizeRule, SizeTerm,
};
pub use straightline_manifest::plan::{
    BufferPlan, FieldPlan, InputKind, InputPlan, OutputPlan, OverridePlan, PartPlan, Plan, StagePlan, TexturePlan,
    UniformPlan, VaryingPlan,
};
pub use straightline_manifest::{Dimension, Extent, Format, OverrideType, SampleType, SamplerType, Scalar, ValueType};

//! Bindings of a SPIR-V module: read from its words, so that modules of any compiler can be asked about.

use ash::vk;
use spirv::{Decoration, ExecutionModel, Op, StorageClass};
use std::collections::{BTreeMap, HashMap, HashSet};

/// Words before the first instruction.
const HEADER: usize = 5;

/// Descriptor type by group and binding number.
pub type Bindings = BTreeMap<u32, BTreeMap<u32, vk::DescriptorType>>;

/// A module's entry point and its bindings.
pub struct Interface {
    /// The stage of the entry point.
    pub stage: vk::ShaderStageFlags,
    /// All that the module binds.
    pub bindings: Bindings,
}

impl Interface {
    /// That of the entry point with a name; `None` if the words are no such module.
    pub fn from_words(words: &[u32], entry: &str) -> Option<Interface> {
        let stage = match read_instructions(words).find_map(|i| entry_point(i, entry))? {
            ExecutionModel::GLCompute => vk::ShaderStageFlags::COMPUTE,
            ExecutionModel::Fragment => vk::ShaderStageFlags::FRAGMENT,
            _ => return None,
        };
        Some(Interface {
            stage,
            bindings: find_bindings(words),
        })
    }
}

/// The opcode of an instruction and its operands.
type Instruction<'a> = (Op, &'a [u32]);

fn read_instructions(words: &[u32]) -> impl Iterator<Item = Instruction<'_>> {
    let mut rest = words.get(HEADER..).unwrap_or_default();
    std::iter::from_fn(move || {
        let first = *rest.first()?;
        let length = (first >> 16) as usize;
        let (instruction, after) = rest.split_at_checked(length.max(1))?;
        rest = after;
        Some((Op::from_u32(first & 0xffff).unwrap_or(Op::Nop), &instruction[1..]))
    })
}

fn entry_point((op, operands): Instruction, name: &str) -> Option<ExecutionModel> {
    let (Op::EntryPoint, [model, _, text @ ..]) = (op, operands) else {
        return None;
    };
    let bytes: Vec<u8> = text.iter().flat_map(|word| word.to_le_bytes()).collect();
    let found = bytes.split(|byte| *byte == 0).next()?;
    (found == name.as_bytes()).then(|| ExecutionModel::from_u32(*model))?
}

/// A type, as far as its bindings depend on it.
#[derive(Clone, Copy)]
enum Type {
    Descriptor(vk::DescriptorType),
    Structure(u32),
    Pointer(u32),
    Array(u32),
}

fn find_bindings(words: &[u32]) -> Bindings {
    let (mut types, mut groups, mut numbers) = (HashMap::new(), HashMap::new(), HashMap::new());
    let (mut storage, mut found) = (HashSet::new(), Bindings::new());
    for (op, operands) in read_instructions(words) {
        match (op, operands) {
            (Op::Decorate, [id, decoration, rest @ ..]) => match (Decoration::from_u32(*decoration), rest) {
                (Some(Decoration::DescriptorSet), [group]) => drop(groups.insert(*id, *group)),
                (Some(Decoration::Binding), [number]) => drop(numbers.insert(*id, *number)),
                (Some(Decoration::BufferBlock), _) => drop(storage.insert(*id)),
                _ => {}
            },
            (Op::TypeImage, [id, _, dimension, _, _, _, sampled, ..]) => {
                let buffer = *dimension == spirv::Dim::DimBuffer as u32;
                let kind = match (*sampled == 2, buffer) {
                    (true, true) => vk::DescriptorType::STORAGE_TEXEL_BUFFER,
                    (true, false) => vk::DescriptorType::STORAGE_IMAGE,
                    (false, true) => vk::DescriptorType::UNIFORM_TEXEL_BUFFER,
                    (false, false) => vk::DescriptorType::SAMPLED_IMAGE,
                };
                types.insert(*id, Type::Descriptor(kind));
            }
            (Op::TypeSampler, [id]) => drop(types.insert(*id, Type::Descriptor(vk::DescriptorType::SAMPLER))),
            (Op::TypeSampledImage, [id, ..]) => {
                types.insert(*id, Type::Descriptor(vk::DescriptorType::COMBINED_IMAGE_SAMPLER));
            }
            (Op::TypeStruct, [id, ..]) => drop(types.insert(*id, Type::Structure(*id))),
            (Op::TypePointer, [id, _, to]) => drop(types.insert(*id, Type::Pointer(*to))),
            (Op::TypeArray | Op::TypeRuntimeArray, [id, of, ..]) => drop(types.insert(*id, Type::Array(*of))),
            (Op::Variable, [ty, id, class, ..]) => {
                let (Some(group), Some(number)) = (groups.get(id), numbers.get(id)) else {
                    continue;
                };
                let class = StorageClass::from_u32(*class);
                if let Some(kind) = descriptor_type(*ty, class, &types, &storage) {
                    found.entry(*group).or_default().insert(*number, kind);
                }
            }
            _ => {}
        }
    }
    found
}

fn descriptor_type(
    mut id: u32,
    class: Option<StorageClass>,
    types: &HashMap<u32, Type>,
    storage: &HashSet<u32>,
) -> Option<vk::DescriptorType> {
    loop {
        match types.get(&id)? {
            Type::Pointer(to) | Type::Array(to) => id = *to,
            Type::Descriptor(kind) => return Some(*kind),
            Type::Structure(block) => {
                let is_storage = class == Some(StorageClass::StorageBuffer) || storage.contains(block);
                return Some(match is_storage {
                    true => vk::DescriptorType::STORAGE_BUFFER,
                    false => vk::DescriptorType::UNIFORM_BUFFER,
                });
            }
        }
    }
}

//! Textures for the pictures of a chain: pictures that are never needed at the same time share one.

use straightline_manifest::Format;
use straightline_manifest::chain::SizeRule;

/// A picture between the pass that draws it and the last one that reads it.
pub struct Life {
    /// Its size.
    pub size: SizeRule,
    /// Its format.
    pub format: Format,
    /// Index of the pass that draws it.
    pub drawn: usize,
    /// Index of the last pass that reads it; `None` if the caller owns it.
    pub last_read: Option<usize>,
}

/// Assigns the number of a texture to each picture; `None` to those of the caller.
pub fn assign_memory(lives: &[Life]) -> Vec<Option<u32>> {
    /// A texture, with the last pass that needs what it holds.
    struct Memory<'l> {
        of: &'l Life,
        needed: usize,
    }
    let mut textures: Vec<Memory<'_>> = Vec::new();
    let assigned = lives.iter().map(|life| {
        let needed = life.last_read?;
        let is_free = |memory: &Memory<'_>| {
            memory.needed < life.drawn && memory.of.size == life.size && memory.of.format == life.format
        };
        let index = match textures.iter().position(is_free) {
            Some(index) => {
                textures[index].needed = needed;
                index
            }
            None => {
                textures.push(Memory { of: life, needed });
                textures.len() - 1
            }
        };
        Some(index as u32)
    });
    assigned.collect()
}

#[cfg(test)]
mod tests {
    use super::{Life, assign_memory};
    use straightline_manifest::Format;
    use straightline_manifest::chain::{SizeRule, SizeTerm};

    fn life(side: u32, drawn: usize, last_read: Option<usize>) -> Life {
        Life {
            size: SizeRule(vec![SizeTerm::Number([side, side])].into()),
            format: Format::Rgba16Float,
            drawn,
            last_read,
        }
    }

    #[test]
    fn pictures_that_take_turns_share_a_texture() {
        let lives = [
            life(4, 0, Some(1)),
            life(4, 1, Some(2)),
            life(4, 2, Some(3)),
            life(4, 3, None),
        ];
        assert_eq!(assign_memory(&lives), [Some(0), Some(1), Some(0), None]);
    }

    #[test]
    fn a_picture_is_kept_as_long_as_it_is_read() {
        let lives = [
            life(4, 0, Some(3)),
            life(4, 1, Some(2)),
            life(4, 2, Some(3)),
            life(4, 3, None),
        ];
        assert_eq!(assign_memory(&lives), [Some(0), Some(1), Some(2), None]);
    }

    #[test]
    fn unlike_pictures_share_nothing() {
        let other = Life {
            format: Format::Rgba8Unorm,
            ..life(4, 4, Some(5))
        };
        let lives = [life(4, 0, Some(1)), life(2, 2, Some(3)), other];
        assert_eq!(assign_memory(&lives), [Some(0), Some(1), Some(2)]);
    }
}

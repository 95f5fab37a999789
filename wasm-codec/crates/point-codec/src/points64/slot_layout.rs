//! Where the blocks of a frame lie in memory.

use super::MAX_BLOCK_BYTES;

/// A block every `stride` bytes, each of them `data_offset` bytes into its slot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SlotLayout {
    pub(super) stride: usize,
    pub(super) data_offset: usize,
}

impl SlotLayout {
    /// `None` where a full block does not fit into its slot.
    #[must_use]
    pub const fn new(stride: usize, data_offset: usize) -> Option<Self> {
        match data_offset.checked_add(MAX_BLOCK_BYTES) {
            Some(end) if end <= stride => Some(Self { stride, data_offset }),
            _ => None,
        }
    }

    /// The bytes from one slot to the next.
    #[must_use]
    pub const fn stride(&self) -> usize {
        self.stride
    }

    /// Where in its slot a block begins.
    #[must_use]
    pub const fn data_offset(&self) -> usize {
        self.data_offset
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_layout_holds_a_full_block() {
        assert!(SlotLayout::new(1216, 16).is_some());
        assert!(SlotLayout::new(1215, 16).is_none());
        assert!(SlotLayout::new(usize::MAX, usize::MAX).is_none());
    }
}

//! Why packets are refused.

/// Why a packet gives no points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// Fewer bytes than a header and a check value.
    TooShort,
    /// More than 1200 bytes.
    TooLong,
    /// The check value is not that of the bytes.
    Check,
    /// Of another version.
    Version,
    /// A field of the header is out of its range.
    Header,
    /// The coded points end too early, too late or at an impossible value.
    Data,
    /// The decoder's memory is full of points.
    Full,
}

/// What a cloud says about a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Class {
    /// Nothing was seen there.
    Unknown = 0,
    /// Its floor was seen, or a ray passed low over it, and nothing stands there.
    Free = 1,
    /// Something stands there that the robot would hit.
    Occupied = 2,
    /// Its floor is missing: what was seen through it lies below the floor.
    DropOff = 3,
}

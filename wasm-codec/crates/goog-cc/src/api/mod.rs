/// A generic congestion control interface: [NetworkControllerInterface](network_control::NetworkControllerInterface).
pub mod network_control;

/// Network structs and types.
pub mod transport;

/// Some unit types, such as [DataSize](units::DataSize) and [DataRate](units::DataRate).
pub mod units;

//! What is said about movement: tiers, component inventories, notation, keys.

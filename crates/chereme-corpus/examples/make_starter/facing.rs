//! Directions of palm and fingers, and the values of the inventories that name them.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_sign::inventory::{InventoryValue, builtin_by_id};

fn values(id: &str) -> &'static [InventoryValue] {
    builtin_by_id(id).map_or(&[][..], |inventory| &inventory.values)
}

/// Returns the unit vector of a value of `directions` in model space.
pub(crate) fn direction(id: &str) -> Option<DVec3> {
    let value = values("directions").iter().find(|value| value.id == id)?;
    Some(DVec3::from(value.direction?).normalize())
}

/// Returns where the hand points and where its palm faces for values of `fingers` and `palm`.
///
/// The palm is said of a hand that points out, which is then turned to its direction by the
/// shortest way, as HamNoSys counts it.
pub(crate) fn vectors(fingers: &str, palm: &str) -> Option<[DVec3; 2]> {
    let fingers = values("fingers").iter().find(|value| value.id == fingers)?;
    let palm = values("palm").iter().find(|value| value.id == palm)?;
    let fingers = DVec3::from(fingers.direction?).normalize();
    let roll = palm.roll?;
    let faced = DVec3::new(-roll.sin(), -roll.cos(), 0.0);
    Some([fingers, DQuat::from_rotation_arc(DVec3::Z, fingers) * faced])
}

/// Returns the values of `fingers` and `palm` nearest to a hand that points and faces so.
pub(crate) fn named(fingers: DVec3, palm: DVec3) -> Option<[&'static str; 2]> {
    let nearest = |id: &str, likeness: &dyn Fn(&InventoryValue) -> Option<f64>| {
        let all = values(id)
            .iter()
            .filter_map(|value| Some((likeness(value)?, value.id.as_str())));
        all.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, id)| id)
    };
    let pointing = nearest("fingers", &|value| {
        Some(DVec3::from(value.direction?).normalize().dot(fingers))
    })?;
    let straight = DQuat::from_rotation_arc(DVec3::Z, fingers.normalize()).inverse() * palm;
    let facing = nearest("palm", &|value| {
        let roll = value.roll?;
        Some(DVec3::new(-roll.sin(), -roll.cos(), 0.0).dot(straight))
    })?;
    Some([pointing, facing])
}

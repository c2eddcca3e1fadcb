//! Two-point fluxes on a mesh: what a user of finite volumes counts on.

#[path = "../../examples/poisson.rs"]
#[allow(dead_code, unreachable_pub, reason = "the example has a main of its own")]
mod example;

#[test]
fn no_transmissibility_is_negative_and_the_error_falls_with_the_square() {
    let solved = [0.01, 0.0025, 0.000_625].map(|area| example::solve(area).unwrap());
    for one in solved {
        assert!(one.min_transmissibility >= 0.0, "{one:?}");
    }
    let order = example::order(solved[0], solved[2]);
    assert!((1.8..2.5).contains(&order), "order {order}: {solved:?}");
}

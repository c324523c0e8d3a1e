//! What is heard of a system of any size.

use crate::{Heard, SoundOptions, Time, Tune, Walk, marked};
use lsystem_drawing::{Figure, System};
use lsystem_syntax::{Halt, Work};

/// Draws a generation of a system.
type Draw<'a> = dyn FnMut(&System, u32, &mut dyn Work) -> Result<Figure, Halt> + 'a;

/// The tune of generation `n`. `draw` draws a generation of a system.
///
/// If there are more lines than [`SoundOptions::notes`], lines at even distances are heard. With [`Time::Length`] such
/// lines would not join, and the last earlier generation that has few enough lines is heard as a whole.
///
/// # Errors
/// The errors of `draw` for generation `n` (with [`Time::Length`]: for generation 0), and [`Halt::Stopped`].
pub fn listen(
    system: &System,
    n: u32,
    options: &SoundOptions,
    draw: &mut Draw<'_>,
    work: &mut dyn Work,
) -> Result<Tune, Halt> {
    let system = &marked(system);
    let mut walk = |n, work: &mut dyn Work| draw(system, n, work).map(|figure| Walk::new(figure, system));
    let is_short = |walk: &Walk| walk.segments() <= options.bounded().notes.into();
    match walk(n, work) {
        Ok(walk) if is_short(&walk) || options.time == Time::Step => return walk.tune(options, work),
        Err(Halt::Stopped) => return Err(Halt::Stopped),
        Err(halt) if options.time == Time::Step => return Err(halt),
        _ => {}
    }
    let mut longest = (walk(0, work)?, 0);
    for earlier in 1..n {
        match walk(earlier, work) {
            Ok(walk) if is_short(&walk) => longest = (walk, earlier),
            Err(Halt::Stopped) => return Err(Halt::Stopped),
            _ => break,
        }
    }
    let (walk, generation) = longest;
    let tune = walk.tune(options, work)?;
    let heard = if tune.heard == Heard::All { Heard::Earlier(generation) } else { tune.heard };
    Ok(Tune { heard, ..tune })
}

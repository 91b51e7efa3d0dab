#pragma once

namespace sessile::app {

/// What holds for the program from its start: a write beyond a limit on file sizes is an error with a sentence, not a
/// signal, and what is written to a standard stream that is closed cannot end up in a file of ours.
void prepare_process();

/// From now on Ctrl-C, SIGTERM, SIGHUP and a reader that has gone only ask for the end; a second Ctrl-C or SIGTERM ends
/// the program at once. Until this is called a signal ends the program as it does any other; one that is ignored, as
/// SIGHUP under nohup, stays so. Calling it again does nothing.
void heed_signals();

/// A signal that was caught in another way asks for the end as well.
void note_stop(int signal);

/// Whether a signal has asked for the end since.
bool stop_asked();

/// What the program exits with when a signal has asked for its end: 128 + its number, as shells have it; 130, Ctrl-C,
/// when none has.
int interrupted_code();

}  // namespace sessile::app

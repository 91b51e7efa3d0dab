#pragma once

namespace sessile::app {

/// From now on Ctrl-C, SIGTERM and a reader that has gone only ask for the end; a second Ctrl-C ends the program at
/// once. Until this is called a signal ends the program as it does any other. Calling it again does nothing.
void heed_signals();

/// Whether a signal has asked for the end since.
bool stop_asked();

}  // namespace sessile::app

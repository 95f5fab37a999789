/** What the page says when the help, the event log or the first drive cannot be opened. */
export const guideWords = {
  driving: 'Let go of the controls first, then open the help.',
  helpNotLoaded: 'The help could not be loaded. Try again.',
  eventsNotLoaded: 'The event log could not be loaded. Try again.',
  tourNotLoaded: 'The first drive could not be loaded. Start it again from the help.',
} as const;

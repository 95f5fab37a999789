/** What the page with several robots side by side says. */
export const wall = {
  title: 'Farpoint: side by side',
  /** Leads to it, below the list of robots. */
  link: 'Side by side',
  region: 'Robots side by side',
  add: 'Add a robot',
  stopAll: 'STOP ALL',
  stopAllHint: 'Stop every robot on this screen (X or F9)',
  /** The heading of a page without a robot. */
  page: (number: number) => `Page ${number}`,
  close: (name: string) => `Close ${name}`,
  keysNowhere: 'Keys go to no robot: click one.',
  keysTo: (name: string) => `Keys and controllers go to ${name}.`,
  cell: {
    unheard: 'This page did not receive STOP: use the robot’s own stop.',
    silent: 'This page does not respond.',
    noRobot: 'No robot is selected.',
    unconfirmed: 'The robot has not confirmed STOP.',
    asked: 'Stopping…',
    away: 'Not connected.',
    stopped: 'Emergency stop is on.',
    drives: 'You are driving.',
    live: 'Live',
  },
  stop: {
    unheard: (count: number, all: number) => `STOP: ${count} of ${all} pages did not receive it.`,
    unconfirmed: (count: number) => `STOP: not confirmed by ${robots(count)}.`,
    stopped: (count: number) => `STOP: ${robots(count)} stopped.`,
    asked: 'Stopping…',
  },
};

function robots(count: number): string {
  return count === 1 ? '1 robot' : `${count} robots`;
}

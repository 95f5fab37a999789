/** Keys and devices, and how fast they drive: what stands beside the controls, and notices. */

export const inputs = {
  /** In the settings. */
  section: 'Driving',
  open: 'Inputs…',
  unnamed: 'Device',
  /** Notices. */
  unknown: (device: string) => `${device} does not drive yet. Set it up: Settings, Inputs.`,
  unplugged: (device: string) => `${device} is gone: it has let go.`,
  /** How fast the operator wants to drive at most. */
  speedTitle: 'Greatest speed',
  speedShare: (percent: number) => `${percent} %`,
  speedKnown: (percent: number, metresPerSecond: string) => `${percent} % · ${metresPerSecond} m/s`,
  speedNotice: (share: string) => `Greatest speed: ${share}`,
  speedChosen: (percent: number) => `${percent} % chosen`,
  gear: 'Next gear',
  /** Names of keys that type nothing, by `KeyboardEvent.code`. */
  keyNames: {
    Space: 'Space',
    ShiftLeft: 'Left Shift',
    ShiftRight: 'Right Shift',
    Backspace: 'Backspace',
    Delete: 'Delete',
    Insert: 'Insert',
    Home: 'Home',
    End: 'End',
    PageUp: 'Page Up',
    PageDown: 'Page Down',
  } as Readonly<Record<string, string>>,
  keypad: (key: string) => `keypad ${key}`,
  /** Beside the controls. What is in braces becomes keys. */
  hint: {
    drive: 'Hold {grip} and drive with {ways}',
    stop: '{estop} stop',
    help: '{help} help',
  },
  titles: {
    estop: (key: string) => `Stop the robot (${key}; F9 also while you type)`,
    release: (key: string) => `Release the emergency stop: hold this button or ${key} for 1 second`,
    robotSwitch: (key: string) => `Switch to another robot (${key}: next robot)`,
  },
};

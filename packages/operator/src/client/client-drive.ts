/** What moves the robot, takes it somewhere, or makes it do something else. And what hands it over. */
import { RobotCommands } from '../commands/robot-commands.ts';
import type { DriveInput } from '../drive/drive-input.ts';
import { Driver } from '../drive/driver.ts';
import { GoalDrive } from '../drive/goal-drive.ts';
import { RobotSwitch } from '../drive/robot-switch.ts';
import type { SeenView } from '../drive/seen-view.ts';
import type { RobotLink } from '../link/robot-link.ts';
import type { Emitter } from './emitter.ts';
import { PeopleRequests } from './people-requests.ts';
import type { RobotEvents } from './robot-events.ts';

export type ClientDrive = {
  driver: Driver;
  goals: GoalDrive;
  commands: RobotCommands;
  people: PeopleRequests;
  /** Leads to another robot. */
  robots: RobotSwitch;
};

/** @param inputs devices that may drive */
export function clientDrive(
  inputs: readonly DriveInput[],
  { link, seen }: { link: RobotLink; seen: SeenView },
  emitter: Emitter<RobotEvents>,
): ClientDrive {
  const driver = new Driver(inputs, {
    sendCommand: (command) => link.sendCommand(seen.stamp(command)),
    sendSession: (message) => link.sendSession(message),
    onOtherDrives: () => emitter.emit('otherDrives', undefined),
    onGripLost: (loss) => emitter.emit('gripLost', loss),
    onGripMissing: (device) => emitter.emit('gripMissing', device),
  });
  const goals = new GoalDrive(driver, {
    sendSession: (message) => link.sendSession(message),
    // Skipped while the path is lost, like a command.
    sendHold: (hold) => {
      if (!link.interrupted) link.sendControl(seen.stamp(hold));
    },
    onChange: (status) => emitter.emit('goal', status),
  });
  // At once, also where STOP does not arrive yet.
  emitter.on('stop', (status) => {
    if (status === 'unconfirmed') goals.cancel('estop');
  });
  const commands = new RobotCommands({
    send: (call) => {
      if (link.phase !== 'live' || link.interrupted) return false;
      link.sendSession(call);
      return true;
    },
    onChange: (list) => emitter.emit('commands', list),
    onResult: (result) => emitter.emit('commandResult', result),
  });
  const robots = new RobotSwitch({
    letGo: () => driver.letGo(performance.now()),
    connect: (robotId) => link.connect(robotId),
  });
  return { driver, goals, commands, people: new PeopleRequests(link), robots };
}

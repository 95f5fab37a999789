/** A process that drives through the command block until it is killed: `node driving-writer.ts --folder …`. */
import { zeroTwist } from '@farpoint/protocol';
import { ReferenceControlWriter } from '../reference/control-writer.ts';
import { readArguments } from './arguments.ts';

const writer = new ReferenceControlWriter({ folder: readArguments().folder, silenceMs: 1000 });
const velocity = zeroTwist();
velocity.linear.x = 0.5;
const drive = () => writer.write(velocity);
drive();
setInterval(drive, 20);
console.log('working');

#!/usr/bin/env node
/** `farpoint-robot`: runs the robot; `init` writes a configuration, `doctor` checks everything. */
const [, , command] = process.argv;
const rest = process.argv.slice(3);

// What a command does not need it does not load. What hangs when the doctor is done ends with it.
if (command === 'init') process.exitCode = (await import('./commands/init.ts')).init(rest, process);
else if (command === 'doctor')
  process.exit(await (await import('./commands/doctor.ts')).doctor(rest, process));
else await (await import('./run.ts')).run();

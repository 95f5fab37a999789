import type { RobotLinkEvents } from '../link/robot-link.ts';
import type { Emitter } from './emitter.ts';
import type { RobotEvents } from './robot-events.ts';

/** Events of the link that the client forwards unchanged. */
export function forwardedEvents(emitter: Emitter<RobotEvents>) {
  return {
    onSignaling: (state) => emitter.emit('signaling', state),
    onRobots: (robots) => emitter.emit('robots', robots),
    onLoss: (loss) => emitter.emit('loss', loss),
    onRefusal: (message) => emitter.emit('refused', message),
    onGrantExpires: (inS) => emitter.emit('grantExpires', inS),
    onRejected: (rejected) => emitter.emit('commandRejected', rejected),
    onOperators: (operators) => emitter.emit('operators', operators),
    onPointed: (pointed) => emitter.emit('pointed', pointed),
    onSensors: (sensors) => emitter.emit('sensors', sensors),
    onRings: (rings) => emitter.emit('rings', rings),
    onTelemetry: (telemetry) => emitter.emit('telemetry', telemetry),
    onReading: (reading) => emitter.emit('reading', reading),
    onQuantity: (quantity) => emitter.emit('quantity', quantity),
    onSamples: (samples) => emitter.emit('samples', samples),
    onNearField: (field) => emitter.emit('nearField', field),
    onPlannedPath: (path) => emitter.emit('plannedPath', path),
    onMap: (tiles) => emitter.emit('map', tiles),
    onDiagnostics: (diagnostics) => emitter.emit('diagnostics', diagnostics),
    onAlarm: (alarm) => emitter.emit('alarm', alarm),
    onRobotFault: (message) => emitter.emit('robotFault', message),
  } satisfies Partial<RobotLinkEvents>;
}

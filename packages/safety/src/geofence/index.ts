export { type Area, depthIn, type Place } from './area.ts';
export { EarthFrame, type EarthOrigin } from './earth-frame.ts';
export { clearance, type Fence, type SlowArea } from './fence.ts';
export { FrozenPosition } from './frozen-position.ts';
export { defaultGeofenceOptions, type FencePose, Geofence, type GeofenceOptions } from './geofence.ts';
export { FenceError, MOST_CORNERS, type ParsedFence, parseFence } from './parse-fence.ts';

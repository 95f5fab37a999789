/** Prediction of the robot's pose at the time a picture is shown ([prediction](../../../../docs/prediction.md)). */
export { type AxisModel, type BaseModel, type BaseMotion, standingAt, usualBase } from './base-model.ts';
export { CameraMount, type HeadingPose } from './camera-mount.ts';
export { MotionPredictor } from './motion-predictor.ts';
export { type PoseSource, ReconciledPose } from './reconciled-pose.ts';
export type { PredictionLimits, PredictionState, ReportedMotion } from './reported-motion.ts';

/** What a guided drive may do. Lengths in metres, speeds in m/s and rad/s, times in ms. */
export interface GuidedOptions {
  /** Goals that are farther from the robot are refused. */
  mostM: number;
  /** Nearer to its goal than this, and told to stand, the robot is there. */
  reachedM: number;
  /** The navigator's velocities are cut to these. */
  maxLinear: number;
  maxAngular: number;
  /** Without a hold of the goal for so long, it ends. */
  watchdogMs: number;
  /** The first hold must come within this. */
  firstHoldMs: number;
  /** A velocity of the navigator that is older counts as zero. */
  navigatorSilentMs: number;
  /** It ends after the navigator has said nothing for so long. */
  navigatorLostMs: number;
  /** It ends after the robot has got nowhere for so long. */
  stuckMs: number;
}

export const defaultGuidedOptions: Readonly<Omit<GuidedOptions, 'maxLinear' | 'maxAngular' | 'watchdogMs'>> =
  Object.freeze({
    mostM: 20,
    reachedM: 0.3,
    firstHoldMs: 1000,
    navigatorSilentMs: 300,
    navigatorLostMs: 10_000,
    stuckMs: 20_000,
  });

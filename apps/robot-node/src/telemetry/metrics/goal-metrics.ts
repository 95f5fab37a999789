import type { PulledMetrics } from '@farpoint/service';
import type { GoalStation } from '../../goals/goal-station.ts';

/** Metrics of a robot that takes goals. */
export function addGoalMetrics(metrics: PulledMetrics, goals: GoalStation): void {
  metrics.gauge('goal_active', '1 while the robot drives to a goal, otherwise 0', () =>
    goals.guided.goal === null ? 0 : 1,
  );
  metrics.sum('goals_taken', 'Goals that the robot has taken', () => goals.taken);
  metrics.sums('goals_refused', 'Goals refused, by reason', 'reason', () => goals.refused.entries());
  metrics.sums('goals_ended', 'Ends of goals that were taken, by reason', 'reason', () =>
    goals.ends.entries(),
  );
  metrics.sum(
    'goal_velocities_invalid',
    'Velocities of the navigator that could not be followed',
    () => goals.invalid,
  );
}

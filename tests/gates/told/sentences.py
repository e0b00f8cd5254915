"""Sentences of the program: one regular expression per check, and the tolerance of printed numbers.

In an expression {name:format} is a number, {name} a part or a word, {name:words} several. Formats are those of printf, and pct
(percent, three digits), rough (percent, two digits below 10 %, else three), length (mm, m or km), th (three decimals; of a thousand
and more three digits), d (a whole number)."""
import re

NUMBER = r"[-+]?(?:\d+\.?\d*(?:e[-+]?\d+)?|nan|inf)"
WITH_UNIT = {"pct": rf"more than 1000 %|less than -1000 %|less than 0\.0001 %|{NUMBER} %",
             "part": rf"less than 0\.01 %|{NUMBER} %", "brief": rf"less than 1 ms|{NUMBER} s",
             "rough": rf"more than 1000 %|less than 0\.0001 %|{NUMBER} %", "length": rf"more than 1000 km|{NUMBER} (?:mm|m|km)"}


def percent(value):
    if abs(value) > 10:
        return "more than 1000 %" if value > 0 else "less than -1000 %"
    if abs(value) >= 1:
        return "%.0f %%" % (100 * value)
    if abs(value) < 1e-6:
        return "less than 0.0001 %" if value > 0 else "0 %"
    return "%.3g %%" % (100 * value)


def rough_percent(value):
    if value > 10:
        return "more than 1000 %"
    if 0 < value < 1e-6:
        return percent(value)
    return "%.0f %%" % (100 * value) if value >= 1 else "%.*g %%" % (2 if value < 0.1 else 3, 100 * value)


def length(metres):
    """Length with three digits, in the unit in which the number is below a thousand."""
    for scale, unit in ((1e3, "mm"), (1, "m"), (1e-3, "km")):
        if abs(metres) * scale < 999.5:
            return f"{metres * scale:.3g} {unit}"
    return "more than 1000 km"


def part(value):
    """Share of a time, which consists of steps."""
    return "less than 0.01 %" if 0 < value < 1e-4 else percent(value)


def brief(seconds):
    return "less than 1 ms" if seconds < 1e-3 else f"{seconds:.3g} s"


def printed(kind, value):
    """Text of a value in a sentence, for this format."""
    if kind in WITH_UNIT:
        return {"pct": percent, "rough": rough_percent, "length": length, "part": part, "brief": brief}[kind](value)
    if kind == "th":
        return "%.3f" % value if value < 1000 else "%.3g" % value
    return "%d" % value if kind == "d" else "%" + kind % value if "%" in kind else ("%" + kind) % value


def same(kind, text, value, loose=0.0):
    """True if a printed number is the rounded recomputed value, which has the tolerance `loose` plus 1e-9 relative (sums of doubles)."""
    value = float(value)
    if value != value:
        return text == "nan"
    slack = 1e-9 * abs(value) + 1e-15 + loose
    ends = [printed(kind, end) for end in (value - slack, value + slack)]
    if text in (printed(kind, value), *ends):
        return True
    said, low, high = (re.fullmatch(rf"({NUMBER})( \S+)?", one) for one in (text, *ends))
    if not (said and low and high and said[2] == low[2] == high[2]):
        return False
    rounded = said[1] == (printed(kind, float(said[1])) if kind not in WITH_UNIT else said[1])
    return rounded and float(low[1]) <= float(said[1]) <= float(high[1])  # rounding preserves the order of numbers


class Expression:
    def __init__(self, text):
        self.kinds, self.count = {}, 0

        def place(match):
            name, _, kind = match[1].partition(":")
            self.count += 1
            group = f"{name}__{self.count}"
            self.kinds[group] = kind.removeprefix("words")
            if kind in ("", "words"):
                return rf"(?P<{group}>.+?)" if kind else rf"(?P<{group}>[^\s;,:]+?)"
            return rf"(?P<{group}>{WITH_UNIT.get(kind, NUMBER)})"

        self.expression = re.compile(re.sub(r"\{([a-z_]+(?::[^}]*)?)\}", place, text))

    def read(self, text):
        """List of (name, kind, printed text), or None if the sentence does not match."""
        match = self.expression.fullmatch(text)
        if not match:
            return None
        return [(group.rpartition("__")[0], kind, match[group]) for group, kind in self.kinds.items() if match[group] is not None]


WITHIN = (r"(?:; with the error of the torques, this is (?:{low:pct} to {high:pct}|slightly less or slightly more than {low:pct}) "
          r"of the limit"
          r"|; joint {other} takes, with the error of its torque, "
          r"(?:{other_low:pct} to {other_high:pct}|slightly less or slightly more than {other_low:pct}) of its limit)?")
LIMITED = (r"no joint is at the limit of its (?:voltage|current|actuator)"
           r"|{parts:d} of {driven:d} joints? reach(?:es)? the limit of (?:its|their) (?:voltage|current|actuator): first "
           r"{first_part}, "
           r"at {first:.2f} s; (?:worst {worst}, )?(?:{share:part} of the judged time, up to {stretch:brief} on end from {from:.2f} s"
           r"|{stretch:brief} on end from {from:.2f} s, (?:more than |of at most ){most:g} control periods \({limit:.3g} s\), "
           r"in all {share:part} of the judged time)")
NEAR = (r"(?:; joint {near_joint} may be at that limit, within the error of its torque \({error:rough}\), for up to {near:part} of "
        r"the judged time, {near_on_end:brief} on end)?")


def dock_sentence(does, unit):
    return (rf"(?:{{worst}}'s dock is {does} by up to {{value:.3g}} {unit}|no dock is {does})"
            r"(?:; the module types do not state the largest loads of docks|, {share:pct} of what it holds(?: by a chosen figure)?"
            r"(?:; {open:d} of {docks:d} docks are not judged: their largest loads are not stated)?)" + WITHIN)


HEIGHT = r"(?:its height above the ground at the start|the height that it would have with all joints at their set points)"
RESTS = r"{value:.3g} rad beyond its stop, which gives {torque:.3g} N m"
JUDGED = {
    "outcome": r"the run came to its end|(?s:.+)",
    "fall": r"the centre of mass keeps at least {value:pct} of " + HEIGHT +
            r"|the robot falls at {from:.2f} s: the centre of mass comes (?:down to {value:pct} of " + HEIGHT +
            r"|{below:.3g} m below the ground)(?:, and does {stays:words})?",
    "progress": r"the robot goes {value:.3g} m (?:per period|in the judged time)(?:, less than {limit:.3g} m)?"
                r"|the robot slides down: gravity does {fallen:.3g} J of work, the motors {driven:.3g} J, and its speed grows "
                r"{value:.3g} times from the first half of the judged time to the second",
    "upright": r"the robot turns over at {from:.2f} s: it tilts by up to {value:.3g} rad from its orientation at the start"
               r"|the robot tilts by up to {value:.3g} rad from its orientation at the start(?:, more than {tilt:.3g} rad \(limits\.tilt\))?",
    "voltage": f"(?:{LIMITED})" + NEAR,
    "current": f"(?:{LIMITED})" + NEAR,
    "envelope": r"the torque of joint {worst} is {value:pct} of its (?:motor|actuator)'s limit at that speed",
    "speed": r"joint {worst} turns at up to {value:.3g} rad/s \(limit {limit:.3g} rad/s\)(?:, more than it is rated for|, faster "
             r"than its motor can drive it: the load drives it)?",
    "stall": r"no driven joint rests|joint {worst} has a stall torque of {limit:.3g} N m and holds {value:.3g} N m at rest(?: for "
             r"0\.1 s from "
             r"{from:.2f} s)?" + WITHIN,
    "heat": r"the motor of joint {worst} takes {value:.3g} A RMS, {share:pct} of its continuous rating" + WITHIN,
    "gear_peak": r"the gear of joint {worst} passes on up to {value:.3g} N m \(rated {limit:.3g} N m\)" + WITHIN,
    "gear_continuous": r"the gear of joint {worst} takes {value:.3g} N m RMS \(rated {limit:.3g} N m\)" + WITHIN,
    "brownout": r"the bus sags to {least:.4g} V of {open:.4g} V(?:, below the {stops:.4g} V that the electronics need for {low:.3g} s, "
                r"first at {first:.2f} s; {first_part} draws the most then)?",
    "battery": r"the motors take {value:.3g} A RMS and at most {peak:.3g} A from the supply, {share:pct} of its largest current",
    "tracking": r"joint {worst} is up to {value:th} rad from its set point",
    "stops": r"no joint leaves its range"
             r"|no joint with a motor leaves its range; {worst} without a motor is up to " + RESTS +
             r"|{parts:d} hinges? without a motor (?:is|are) pressed far beyond the stop; worst {worst}: " + RESTS +
             r"|{parts:d} joints? leaves? the range of the hinge; worst {worst}: (?:by {angle:.3g} rad, "
             r"for {share:pct} of the run|for {share:pct} of the run \(at most {most:pct}\), by up to {angle:.3g} rad)",
    "setpoints": r"no set point leaves the range of its hinge|the set point of joint {worst} is beyond the range of its hinge for "
                 r"{value:pct} of the run",
    "start": r"the set point of joint {worst} is {value:.3g} rad from its angle at t = 0(?:, and its motor reacts at once: peaks "
             r"of the whole run may result from this jump)?",
    "collision": r"no two bodies overlap more than by design"
                 r"|{parts:d} pairs? of bodies pass(?:es)? through one another, deepest {worst} and {other}, by {value:length}",
    "dock_tension": dock_sentence("pulled apart", "N"),
    "dock_shear": dock_sentence("sheared", "N"),
    "dock_bending": dock_sentence("bent", "N m"),
    "dock_torsion": dock_sentence("twisted", "N m"),
    "in_ground": r"no body goes through the ground|body {worst} goes {value:length} into the ground",
    "slip": r"no foot slides under load|feet under load slide {slip:length} on average, {value:pct} of the way of {way:length}; "
            r"farthest foot {foot:words}, {slid:length}",
    "airborne": r"the ground carries less than {weight:pct} of the weight for {value:pct} of the judged time",
    "stability": r"a note: no foot bears a load for {aloft:pct} of the time; otherwise the centre of mass stays {way:length} within "
                 r"the "
                 r"support polygon|statically stable: the centre of mass stays {way:length} within the support polygon"
                 r"|a note: the centre of mass leaves the support polygon by up to {way:length} and is outside for {outside:pct} of "
                 r"the time on the ground, as may happen in a dynamic gait",
    "field": r"the robot stays on its heightfield|the robot leaves its heightfield at t = {t:.2f} s, x {x:.3g} m, y {y:.3g} m: "
             r"beyond it the heights of the border continue",
    "periodic": r"the motion repeats every {period:.4g} s|the set points repeat, but the motion does not settle to a period",
    "evidence": r"judged over (?:{periods:d} periods? of {period:.4g} s|{inside:.3g} periods of {period:.4g} s(?: after {start:.3g} "
                r"s)?; the motion does "
                r"not settle|the {simulated:.3g} s of the run; the set points do not repeat)(?:; not known: {unknown:words})?"
                r"(?:; limits: {limits:words})?(?:; accepted: {accepted:words})?",
    "torque_error": r"the torque of joint {worst} is off by about {value:rough} of its peak, estimated by comparison with other step lengths(?: in windows of the run; "
                    r"`gaitlab converge` compares whole runs)?",
    "predictable": r"(?:from t = {from:.4g} s on \(joint {worst}\) the motion is (?:not predictable|ill-conditioned): )?gravity times "
                   r"{times:words} changes the torques by (?:about )?{value:rough} of their peak"
                   r"(?: \(in proportion to 1 \+ 1e-9\))?(?:; in {rollouts:d} rollouts that differ by next to nothing, the torque "
                   r"peaks at {low_peak:.3g}(?: to {high_peak:.3g})? N m \(RMS {low_rms:.3g}(?: to {high_rms:.3g})?\), the travel "
                   r"is {low_way:length}(?: to {high_way:length})? and the least margin is (?:{low_margin:pct}(?: to "
                   r"{high_margin:pct})?|no number))?",
    "creep": r"where a real ground would hold the feet, they creep {crept:length}, {value:pct} of the travel of {way:length}"
             r"(?:; contact\.slip_speed: {half:.3g} would halve it)?",
    "ledger": r"{value:pct} of the energy is unaccounted for(?:: {missing:.3g} J, of {drawn:.3g} J drawn)?",
    "created": r"gears that are driven backwards create {value:pct} of the energy \(eq\. 2\)"
               r"(?:; take actuator\.efficiency_model: directional)?",
    "supply": r"the motors draw {value:.3g} J|the motors gave {gave:.3g} J back to their supply instead of drawing any, so that the "
              r"cost of transport is negative: the robot went down, or a motor makes energy",
    "step": r"the step is too long in {value:pct} of the control ticks|h lambda exceeds 1 in {value:pct} of the control ticks",
    "coarse": r"in {value:rough} of the time the shortest steps of the integrator did not reach the accuracy {accuracy:rough}"
              r"(?:: the result depends on the steps, and smaller steps may not change this)?",
    "law": r"every joint-step satisfies the law of its motor and end stop|{value:.0f} joint-steps do not satisfy the law of their motor "
           r"or stop: their torques are wrong",
}
# Sentences on missing evidence: of the check `evidence`, and of a verdict that is not judged.
MISSING = (r"{left:.3g} s(?: after {start:.3g} s)? contain only {held:.2g} of the 3 periods of {period:.4g} s that a gait needs; "
           r"take duration: {take:.4g}"
           r"|the set points still grow: they reach their full size at {full_at:.4g} s, but the run ends at {simulated:.4g} s; take "
           r"(?:duration: {take_full:.4g}"
           r"|another rate)|the set points still grow: those of joint .*"
           r"|the set points {way}: the {level} of joint {grower} changes by {by:.2g} rad per period of {each:.3g} s, with a range "
           r"of {width:.3g} rad"
           r"|the motors of module {powerful} \({heavy:.4g} kg\) have {power:.3g} W: {density:.3g} W/kg, but no motor has more than "
           r"1500 W/kg"
           r"(?: \(and {weaker:d} more\))?; give values that are physically possible, or accept: \[power\]"
           r"|the run of {simulated:.3g} s is shorter than the required {least:g} s; take a longer duration"
           r"|the ground carries {borne:pct} of the weight on average, less than {half:pct}: the robot is not on it"
           r"|there is no gravity, so that no ground bears the robot(?:; take physics\.gravity, or base: fixed)?"
           r"|the robot falls freely: (?:there is no ground(?:; take base: fixed, or a ground)?"
           r"|no part of it touches the ground(?:; take base: fixed, or contact\.on: all)?)"
           r"|the motor of joint {creator} makes energy: efficiency x Kt {x:.4g} N m/A exceeds Ks {y:.4g} V s/rad; take Kt = Ks"
           r"|no set point changes(?: after {full:.3g} s)?: (?:cpg {cpg} moves no joint|there is no cpg)"
           r"(?:; check its frequency, amplitudes, frames or equations)?"
           r"|the torque of joint {inaccurate} is off by about {off:rough} of its peak, more than {most:pct}; take .*"
           r"|from t = {parted:.4g} s on \(joint {unpredictable}\) the motion is not predictable: gravity times {times:words} "
           r"changes the "
           r"torques by {change:rough} of their peak; .*"
           r"|the error of the torques is not estimated; take physics\.estimate: full"
           r"|{residual:pct} of the energy is unaccounted for, more than {kept:pct}; take .*"
           r"|in {coarse:rough} of the time the shortest steps do not reach the accuracy {accuracy:rough}; look for .*")
# The sentence of a run whose controller is unstable.
UNSTABLE = (r"the controller is unstable from {since:.3g} s on \((?:Kp .*, )?a command every {control:.4g} s\): the command of "
            r"(?:{torn:d} joints|{only}) changes its sign in most control ticks; {thrower} (?:goes {beyond:.3g} rad beyond its range"
            r"|throws the base about at {thrown:.3g} m/s)")
# Sentences with the reason for which a check is not judged. Numbers in these sentences are also recomputed.
NOT_JUDGED = (
    r"judged only for a floating base(?: above a ground| on a ground| that gravity holds on a ground, if the ground's forces are "
    r"recorded)?"
    r"|the base rolls: it makes a whole turn in every period"
    r"|the robot turns over at {over:.2f} s, and the run is too short to show whether it rolls"
    r"|nothing drives the joints(?:, or statistics of all steps were not recorded)?"
    r"|the actuator (?:is not made of DC motors, and has no (?:voltage|stall torque)|states no limit|has torque at any speed, and "
    r"states no "
    r"largest speed)"
    r"|no (?:continuous current of the motors|(?:largest|continuous) torque of the gears) is stated \(actuator\.\w+\)"
    r"|the solver of contact\.law bullet keeps bodies apart and above the ground|no body has a shape, or the run has no poses"
    r"|{shaped:d} of {bodies:d} bodies have a shape|the centre of mass is in the ground in the start pose"
    r"|judged only (?:above a ground|on a heightfield|on a plane without boxes)|the robot starts beside its heightfield"
    r"|the robot has no dock|no foot bears a load"
    r"|not available with contact\.law: bullet, which yields impulses that do not all act at contact elements"
    r"|the robot goes only {way:length}: less than {least_way:length} does not count as walking"
    r"|the robot goes {value:.3g} m (?:per period|in the judged time), less than {limit:.3g} m"
    r"|the set points do not repeat|the run does not show the gait|the error of the torques was not estimated in this run"
    r"|not tested: (?:no rollout under a disturbed gravity was made|a disturbed gravity changes no torque of this robot)"
    r"|the integrator does not choose its steps by an accuracy|no damping rate \(lambda\) was recorded"
    r"|loads were not recorded: .*|statistics of all steps were not recorded: .*|the robot has no size, or the run has no control "
    r"ticks")
SPREAD = (r"(?:; the motion is not predictable: in {rollouts:d} rollouts that differ by next to nothing, "
          r"(?:the margin is {margin_low:pct} to {margin_high:pct}|this check cannot judge {without:d} of them))?")
CERTAIN = r"(?:; this is certain, although torques are off by up to about {off_by:rough})?"
EXPRESSIONS = {check: Expression(text if check == "outcome" else f"(?:{text}){SPREAD}{CERTAIN}") for check, text in JUDGED.items()}
WHY_NOT = Expression(NOT_JUDGED)
LACKS = Expression(MISSING)
TORN = Expression(UNSTABLE)
RESTS_ON = Expression(JUDGED["evidence"].removeprefix("judged over "))
NO_MOTORS = Expression(r"no limit of the motors is known|nothing drives the joints|(?:fall|in_ground) was not judged: .*")
OPEN_DOCK = {check: Expression(JUDGED[check]) for check in JUDGED if check.startswith("dock_")}


def read(check, status, text):
    if check == "evidence" and status != "pass":
        found = [LACKS.read(one) for one in text.split("; and ")]
        return None if None in found else [number for one in found for number in one]
    if status == "not judged":
        found = WHY_NOT.read(text)
        return OPEN_DOCK[check].read(text) if found is None and check in OPEN_DOCK else found
    return EXPRESSIONS[check].read(text)

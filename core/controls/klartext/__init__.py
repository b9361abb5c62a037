"""HEIDENHAIN conversational programs: read, rounded and chamfered, compensated with RL and RR."""

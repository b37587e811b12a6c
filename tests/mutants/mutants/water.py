"""Water without YADE: meshes, conditions, seepage, fields in time and in files, forces. Python, judged by pytest."""
from mutant import mutant

WATER = "py/nonsmooth/water/"
MESH, MESHER, CONDITIONS, EQUATIONS, SEEPAGE, PHREATIC, FIELDS, FILES, FORCES = (
    WATER + name
    for name in ("mesh.py", "mesher.py", "conditions.py", "equations.py", "seepage.py", "phreatic.py", "fields.py", "field_files.py", "forces.py")
)
MESHES, FLOW, FIELD, DISKS = "plain:test_water_mesh.py", "plain:test_seepage.py", "plain:test_fields.py", "plain:test_water_forces.py"

MUTANTS = (
    # ---- meshes
    mutant("seepage-mesh-turned", MESH, "triangles = np.where(double[:, None] < 0, triangles[:, [0, 2, 1]], triangles)", "pass", "clockwise triangles have areas below 0",
           MESHES + "::test_a_mesh_of_arrays_is_turned_and_rid_of_idle_nodes"),
    mutant("seepage-mesh-diagonal", MESH, "rising = ((i + j) % 2 == 0)[:, None]", "rising = (i >= 0)[:, None]", "a grid is not its own mirror image",
           MESHES + "::test_a_grid_covers_its_rectangle_and_is_its_own_mirror_image"),
    mutant("seepage-locate-box", MESH, "(points - (x0, y0)) / wide", "points / wide", "points are looked for from the origin", MESHES + "::test_each_point_is_found_in_its_triangle"),
    mutant("seepage-mesh-joint", MESHER, "chain += [a, *on[np.argsort(along[on], kind=\"stable\")]]", "chain += [a]", "a corner on a neighbour's edge is no node of it",
           MESHES + "::test_layers_that_touch_have_common_nodes"),
    mutant("seepage-mesh-own", MESHER, '"GMSH_HOME": folder, "HOME": folder', '"FOLDER": folder', "a person's own options change the mesh",
           MESHES + "::test_the_same_polygons_give_the_same_bits_whatever_a_person_has_set"),
    # ---- conditions
    mutant("seepage-rain-slope", CONDITIONS, "np.maximum(-along[edges, 0], 0)", "length[edges]", "rain falls along the normal of a slope",
           FLOW + "::test_rain_falls_on_the_horizontal_and_inflow_goes_through_the_line"),
    mutant("seepage-reservoir-face", CONDITIONS, "nodes = nodes[y[nodes] <= one.level + mesh.tolerance]", "pass", "a reservoir presses above its level",
           FLOW + "::test_the_discharge_the_free_surface_and_the_exit_of_dams"),
    mutant("seepage-pressure-head", CONDITIONS, "PressureHead: lambda: y[nodes] + one.height", "PressureHead: lambda: 0 * y[nodes] + one.height", "a pressure head is a head",
           FLOW + "::test_an_artesian_base_has_its_pressure_everywhere_and_the_body_a_linear_one"),
    # ---- the equations
    mutant("seepage-one-way", EQUATIONS, "balance += self.open * np.maximum(head - self.y, 0)", "balance += self.open * (head - self.y)", "a seepage face sucks air's water in",
           FLOW + "::test_the_discharge_the_free_surface_and_the_exit_of_dams"),
    mutant("seepage-passing", EQUATIONS, "PASSING = 4.0", "PASSING = 0.0", "rain does not get through dry ground", FLOW + "::test_rain_on_a_dam_leaves_on_both_sides"),
    mutant("seepage-transposed", EQUATIONS, 'np.einsum("mia,mab,mjb->mij", g, conductivity, g)', 'np.einsum("mia,mab,mjb->mij", g[..., ::-1], conductivity, g[..., ::-1])',
           "x and y of the conductivity are exchanged", FLOW + "::test_uniform_flow_is_exact_for_any_direction_of_flow_and_bedding"),
    mutant("seepage-dip", SEEPAGE, "np.array([math.cos(angle), -math.sin(angle)])", "np.array([math.cos(angle), math.sin(angle)])", "bedding dips the other way", FLOW + "::test_tensors"),
    mutant("seepage-layers", SEEPAGE, "enumerate(conductivity)])[mesh.layer]", "enumerate(conductivity)])[0 * mesh.layer]", "all layers conduct as the first",
           FLOW + "::test_layers_along_the_flow_add_up_and_layers_across_it_add_their_resistances"),
    mutant("seepage-flux", SEEPAGE, "flux = -(dry + (1 - dry) * wet)", "flux = (dry + (1 - dry) * wet)", "water flows uphill", FLOW + "::test_uniform_flow_is_exact_for_any_direction_of_flow_and_bedding"),
    mutant("seepage-discharge", SEEPAGE, "right = np.array([b[1] - a[1], a[0] - b[0]])", "right = np.array([a[1] - b[1], b[0] - a[0]])", "a discharge has the wrong sign",
           FLOW + "::test_uniform_flow_is_exact_for_any_direction_of_flow_and_bedding"),
    mutant("seepage-falling", SEEPAGE, "FALLING = 0.1", "FALLING = 0.0", "what drips from a seam of clay is never solved",
           FLOW + "::test_water_that_drips_from_a_seam_of_clay_falls_through_dry_ground"),
    mutant("seepage-share", PHREATIC, "np.where(two, 1 - dry, np.where(low >= 0, 1.0, 0.0))", "np.where(two, dry, np.where(low >= 0, 1.0, 0.0))", "a triangle with two wet corners is wet by what is dry",
           FLOW + "::test_the_discharge_the_free_surface_and_the_exit_of_dams"),
    # ---- fields and forces
    mutant("seepage-time", FIELDS, "(time - times[first]) / (times[first + 1] - times[first])", "(times[first + 1] - time) / (times[first + 1] - times[first])", "between two states time runs backwards",
           FIELD + "::test_pressures_are_linear_in_time_and_stay_before_and_after"),
    mutant("seepage-dry", FIELDS, "wet = (where >= 0) & (self.mesh.at(values, points, where) > 0)", "wet = where >= 0", "dry ground has a gradient", FIELD + "::test_dry_ground_has_no_pressure_and_no_gradient"),
    mutant("seepage-along", FIELDS, "(1 + np.square(slope) if self.along else", "(np.sqrt(1 + np.square(slope)) if self.along else", "seepage along a slope has cos and not cos²",
           FIELD + "::test_water_that_flows_along_a_slope_has_the_pressure_of_parallel_seepage"),
    mutant("seepage-file-kept", FILES, "return MeshField(mesh, data[\"times\"], values[:, kept])", "return MeshField(mesh, data[\"times\"], values[:, : len(kept)])", "idle nodes shift the pressures of a file",
           FIELD + "::test_idle_nodes_of_an_hdf5_file_take_their_pressures_along"),
    mutant("seepage-force-sign", FORCES, "return -field.gradient(points, time, outside) * own[:, None]", "return field.gradient(points, time, outside) * own[:, None]", "still water pulls down",
           DISKS + "::test_still_water_bears_the_weight_of_what_it_gives_way_to"),
    mutant("seepage-pores", FORCES, "unit_weight * own * (1 - share) / share", "unit_weight * own * (1 - share)", "of the pores' water a share is forgotten",
           DISKS + "::test_still_water_bears_the_weight_of_what_it_gives_way_to"),
    mutant("seepage-critical", FORCES, "packing_fraction * (density / water_density - 1)", "(1 - packing_fraction) * (density / water_density - 1)", "porosity stands for the packing fraction",
           DISKS + "::test_grains_float_at_the_critical_gradient"),
    mutant("seepage-flow-lines", "py/nonsmooth/figures/water.py", "flow = np.abs(way[:, 0] * result.flux[where, 1] - way[:, 1] * result.flux[where, 0])", "flow = np.hypot(*way.T)",
           "flow lines are equally far apart whatever flows", "plain:test_figures_water.py::test_between_flow_lines_flows_the_same"),
)
